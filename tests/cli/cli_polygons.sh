#!/usr/bin/env bash
# locate --polygons: features that contain points, borders, holes, overlaps; attributes; what is
# refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# LeakSanitizer stops all threads when the program ends, and sometimes crashes over those of GDAL,
# which end at that time.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

# Feature 0: a square with a hole and an island; 1: its neighbour to the right; 2: no geometry; 3:
# two parts, one of which lies over both.
cat >parcels.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"id":"A.1","use":"a, \"b\"","area":15.5,"n":1},"geometry":{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[3,1],[3,3],[1,3],[1,1]],[[1.5,1.5],[2.5,1.5],[2.5,2.5],[1.5,2.5]]]}},
{"type":"Feature","properties":{"id":"B","use":null,"area":16,"n":2},"geometry":{"type":"Polygon","coordinates":[[[4,0],[8,0],[8,4],[4,4],[4,0]]]}},
{"type":"Feature","properties":{"id":"C"},"geometry":null},
{"type":"Feature","properties":{"id":"D","use":"road","area":0.25,"n":4},"geometry":{"type":"MultiPolygon","coordinates":[[[[3.5,0.5],[5,0.5],[5,3.5],[3.5,3.5],[3.5,0.5]]],[[[10,0],[11,0],[11,1],[10,0]]]]}}]}
END
points='id;x;y
1;0,5;0,5
2;2;1,25
3;2;2
4;4;0,25
5;4;2
6;3,5;2
7;5;2
8;3;2
9;10,75;0,25
10;9;9
11;;
'
run_on "$points" locate --points-crs same --polygons parcels.geojson -; exits 0; says_nothing
prints 'id;x;y;status;feature;others
1;0,5;0,5;inside;0;
2;2;1,25;outside;-1;
3;2;2;inside;0;
4;4;0,25;border;0;1
5;4;2;border;0;1 3
6;3,5;2;inside;0;3
7;5;2;inside;1;3
8;3;2;border;0;
9;10,75;0,25;inside;3;
10;9;9;outside;-1;
11;;;bad;-1;'
run_on "$points" locate --details --only-answers --polygons parcels.geojson -; exits 0
prints 'x,y,status,feature,others,border_of
0.5,0.5,inside,0,,
2,1.25,outside,-1,,
2,2,inside,0,,
4,0.25,border,0,1,0 1
4,2,border,0,1 3,0 1
3.5,2,inside,0,3,3
5,2,inside,1,3,3
3,2,border,0,,0
10.75,0.25,inside,3,,
9,9,outside,-1,,
nan,nan,bad,-1,,'
run_on "$points" locate --strict --polygons parcels.geojson - --stats; exits 1
for line in 'inside +5' 'border +3' 'outside +2' 'bad +1' 'in several +4' 'polygons +4' \
    'crossing segments +[1-9]'; do
    says "^$line"
done
# The same by every walk and from every start.
run_on "$points" locate --polygons parcels.geojson -; cp "$logs/out" expected
for how in '--walk straight' '--walk celestial --start kd-tree' '--start layers --threads 3' \
    '--walk border'; do
    # shellcheck disable=SC2086 # words
    run_on "$points" locate $how --polygons parcels.geojson -; exits 0; prints "$(<expected)"
done

# Polygons that are not valid: what is outside and inside is said, and the features are named.
cat >invalid.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[2,2],[2,0],[0,2],[0,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[4,0],[6,0],[6,2],[4,2],[4,0]],[[4,0],[6,0],[6,2],[4,2],[4,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[8,0],[10,0],[10,2]],[[12,0],[13,0],[13,1],[12,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"MultiPolygon","coordinates":[[[[20,0],[22,0],[22,2],[20,2],[20,0]]],[[[21,1],[23,1],[23,3],[21,3],[21,1]]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[30,0],[31,0],[30,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,5],[9,5]]}}]}
END
run_on $'x,y\n1,0.5\n1,1\n0.5,1\n5,1\n4,1\n9.5,0.5\n12.75,0.5\n21.5,1.5\n21,1.5\n30.5,0\n5,5\n' \
    locate --polygons invalid.geojson -
exits 0
prints 'x,y,status,feature,others
1,0.5,outside,-1,
1,1,border,0,
0.5,1,inside,0,
5,1,outside,-1,
4,1,border,1,
9.5,0.5,inside,2,
12.75,0.5,inside,2,
21.5,1.5,inside,3,
21,1.5,inside,3,
30.5,0,outside,-1,
5,5,outside,-1,'
says 'invalid.geojson: warning: the border of feature 0 crosses itself or runs along itself; a point is inside if the border goes round it an odd'
says 'warning: the border of feature 1 crosses itself'
says 'feature 4: ring 0 of polygon 0 has fewer than three different points: the polygon is skipped'
says 'warning: 1 segments of lines are skipped'
holds "valid features are not named" test "$(grep -c 'crosses itself' "$logs/err")" -eq 2
run_on $'1 1\n' locate -q --polygons invalid.geojson -; exits 0; says_nothing

# Triangle's .poly is one feature, its domain: an inner ring without the place of a hole parts it,
# and is no border.
cat >domain.poly <<'END'
12 2 0 0
1 0 0
2 9 0
3 9 9
4 0 9
5 1 1
6 3 1
7 3 3
8 1 3
9 5 5
10 7 5
11 7 7
12 5 7
12 0
1 1 2
2 2 3
3 3 4
4 4 1
5 5 6
6 6 7
7 7 8
8 8 5
9 9 10
10 10 11
11 11 12
12 12 9
1
1 2 2
END
run_on $'2 2\n1 2\n6 6\n5 6\n0 3\n-1 3\n' locate --only-answers --polygons domain.poly -; exits 0
prints 'x,y,status,feature,others
2,2,outside,-1,
1,2,border,0,
6,6,inside,0,
5,6,inside,0,
0,3,border,0,
-1,3,outside,-1,'

# What is refused, before anything is printed.
printf '%s\n' "$square" >square.off
run locate square.off; refused 2 'locate: expected MESH POINTS, found 1 argument'
run locate --polygons parcels.geojson square.off absent.csv
refused 2 "only POINTS may follow, not also 'absent.csv'"
run locate --polygons - -; refused 2 'cannot be both'
run locate --attribute id square.off -; refused 2 "'--attribute' needs --polygons"
run locate --polygon-layer a square.off -; refused 2 "'--polygon-layer' needs --polygons"
for option in '--tolerance 1' --any '--fill no'; do
    # shellcheck disable=SC2086 # words
    run locate $option --polygons parcels.geojson -
    refused 2 "'${option%% *}' is for meshes, not for --polygons"
done
run_on $'x,y\n0,0\n' locate --polygons parcels.geojson - -o parcels.geojson
refused 2 'parcels.geojson'
run locate --polygons absent.geojson -; refused 3 'absent.geojson: '
printf '{"type":"Point","coordinates":[0,0]}' >point.geojson
run_on $'0 0\n' locate --polygons point.geojson -
refused 3 'point.geojson: there are no polygons in it'
printf '{"type":"Polygon","coordinates":[[[0,0],[1,1],[2,2],[0,0]]]}' >flat.geojson
run_on $'0 0\n' locate --polygons flat.geojson -; refused 3 'flat.geojson: .*line'
printf '5 2 0 0\n1 0 0\n2 2 2\n3 2 0\n4 0 2\n5 5 5\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n' \
    >crossing.poly
run_on $'0 0\n' locate --polygons crossing.poly -
refused 3 'crossing.poly: segments .* cross near 1 1'

# Attributes, by GDAL.
run_on "$points" locate --points-crs same --polygons parcels.geojson --attribute id,use,area,n -
if grep -Eq 'built without GDAL|cannot be loaded' "$logs/err"; then
    refused 3 'parcels.geojson: '
    finish
fi
exits 0; says_nothing
prints 'id;x;y;status;feature;others;id_mw;use;area;n
1;0,5;0,5;inside;0;;"A.1";"a, ""b""";15,5;1
2;2;1,25;outside;-1;;;;;
3;2;2;inside;0;;"A.1";"a, ""b""";15,5;1
4;4;0,25;border;0;1;"A.1";"a, ""b""";15,5;1
5;4;2;border;0;1 3;"A.1";"a, ""b""";15,5;1
6;3,5;2;inside;0;3;"A.1";"a, ""b""";15,5;1
7;5;2;inside;1;3;B;;16;2
8;3;2;border;0;;"A.1";"a, ""b""";15,5;1
9;10,75;0,25;inside;3;;D;road;0,25;4
10;9;9;outside;-1;;;;;
11;;;bad;-1;;;;;'
run_on "$points" locate --polygons parcels.geojson --attribute ID -; exits 0; prints_line ';id_mw$'
run_on "$points" locate --polygons parcels.geojson --attribute use,owner -
refused 3 "parcels.geojson: has no attribute 'owner'; it has: id, use, area, n"
run_on "$points" locate --polygons parcels.geojson --polygon-layer none -
refused 3 "has no layer 'none'; it has: parcels"
# Through a vector file, both ways; with several layers one has to be chosen.
cat >points.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"p"},"geometry":{"type":"Point","coordinates":[0.5,0.5]}},
{"type":"Feature","properties":{"name":"q"},"geometry":{"type":"Point","coordinates":[4,2]}}]}
END
run locate --polygons parcels.geojson --attribute use,area points.geojson -o out.gpkg; exits 0
run locate --only-answers --polygons parcels.geojson out.gpkg; exits 0
prints $'x,y,status,feature,others\n0.5,0.5,inside,0,\n4,2,border,0,1 3'
mkdir layers.d && cp parcels.geojson layers.d/a.geojson
run_on $'4 2\n' locate --polygons out.gpkg -; refused 3 'out.gpkg: '
cat >two.gml <<'END'
<?xml version="1.0"?>
<c:FeatureCollection xmlns:c="http://x/" xmlns:gml="http://www.opengis.net/gml">
<gml:featureMember><c:town gml:id="t1"><c:name>Ulm</c:name><c:g><gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>0,0 1,0 1,1 0,1 0,0</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon></c:g></c:town></gml:featureMember>
<gml:featureMember><c:lake gml:id="l1"><c:name>See</c:name><c:g><gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>5,5 6,5 6,6 5,6 5,5</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon></c:g></c:lake></gml:featureMember>
</c:FeatureCollection>
END
run_on $'0.5 0.5\n' locate --polygons two.gml -
refused 2 'two.gml: which layer has the polygons\? --polygon-layer may be one of: town, lake'
run_on $'5.5 5.5\n' locate --polygons two.gml --polygon-layer lake --attribute name -; exits 0
prints $'x,y,status,feature,others,name\n5.5,5.5,inside,0,,See'

# More features over a point than a thread has room for at first, and just as many; a border counts
# as one only where no part of the feature has the point inside.
for count in 64 65 90; do
    {
        printf '{"type":"FeatureCollection","features":['
        for ((i = 0; i < count; i++)); do
            ((i == 0)) || printf ','
            printf '{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":'
            printf '[[[-%d,-1],[%d,-1],[%d,1],[-%d,1],[-%d,-1]]]}}' $((i + 1)) $((i + 1)) \
                $((i + 1)) $((i + 1)) $((i + 1))
        done
        printf ']}'
    } >pile.geojson
    run_on $'x,y\n0,0\n1,0\n1.5,0\n' locate --polygons pile.geojson -; exits 0
    prints "x,y,status,feature,others
0,0,inside,0,$(seq -s ' ' 1 $((count - 1)))
1,0,border,0,$(seq -s ' ' 1 $((count - 1)))
1.5,0,inside,1,$(seq -s ' ' 2 $((count - 1)))"
done
cat >parts.geojson <<'END'
{"type":"Feature","properties":{},"geometry":{"type":"MultiPolygon","coordinates":[
[[[0,0],[1,0],[1,1],[0,1],[0,0]]],[[[0.5,-1],[2,-1],[2,2],[0.5,2],[0.5,-1]]]]}}
END
run_on $'x,y\n1,0.5\n2,0.5\n0,0.5\n' locate --polygons parts.geojson - -q; exits 0
prints 'x,y,status,feature,others
1,0.5,inside,0,
2,0.5,border,0,
0,0.5,border,0,'

# Ten features whose borders cross are named, the others are counted.
for count in 10 11 13; do
    {
        printf '{"type":"FeatureCollection","features":['
        for ((i = 0; i < count; i++)); do
            ((i == 0)) || printf ','
            printf '{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":'
            printf '[[[%d,0],[%d,2],[%d,2],[%d,0],[%d,0]]]}}' $((9 * i)) $((9 * i + 2)) \
                $((9 * i)) $((9 * i + 2)) $((9 * i))
        done
        printf ']}'
    } >bows.geojson
    run_on $'x,y\n1,0.5\n' locate --polygons bows.geojson -; exits 0
    holds "ten are named" test "$(grep -c 'warning: the border of feature' "$logs/err")" == 10
    if ((count > 10)); then
        says "^meshwalk: bows.geojson: warning: the borders of $((count - 10)) others do so, too$"
    else
        holds "no others" test -z "$(grep others "$logs/err")"
    fi
    run_on $'x,y\n1,0.5\n' locate --polygons bows.geojson - -q; exits 0; says_nothing
done
finish
