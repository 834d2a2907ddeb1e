#!/usr/bin/env bash
# triangulate --constraints: files and their mistakes, what is kept, crossings, heights and fields,
# GDAL, real files; and the kinds of triangulation.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"

# A square with a square hole that has an island, as .poly (the island bounds nothing there) and as
# GeoJSON.
square_poly='# a square, a hole
8 2 0 0
1 0 0
2 6 0
3 6 6
4 0 6
5 2 2
6 4 2
7 4 4
8 2 4
8 0
1 1 2
2 2 3
3 3 4
4 4 1
5 5 6
6 6 7
7 7 8
8 8 5
1
1 3 3'
lake='{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
{"type": "MultiPolygon", "coordinates": [[[[0,0],[6,0],[6,6],[0,6],[0,0]],
[[2,2],[4,2],[4,4],[2,4],[2,2]]],
[[[2.5,2.5],[3.5,2.5],[3.5,3.5],[2.5,3.5],[2.5,2.5]]]]}}]}'
printf '%s\n' "$square_poly" >s.poly
printf '%s\n' "$lake" >lake.geojson
printf '0 0\n1 0\n0 1\n' >three.xyz
geojson=true
run triangulate --constraints lake.geojson -o lake.off
if grep -q 'built without Jansson' "$logs/err"; then geojson=false; else exits 0; fi
gdal=true
printf 'no vector file\n' >unknown.txt
run triangulate --constraints unknown.txt -o m.off; refused 3 "unknown\.txt"; absent m.off
if grep -q 'built with GDAL' "$logs/err"; then
    gdal=false
    says "constraints are read from GeoJSON and \.poly"
fi

# Mistakes.
run triangulate --constraint s.poly -o m.off; refused 2 "did you mean '--constraints'\?"
run triangulate --constraints s.poly --keep insid -o m.off
refused 2 "unknown part to keep 'insid'; did you mean 'inside'\?"
run triangulate --constraints s.poly --kind greedy -o m.off; refused 2 "for --kind delaunay only"
run triangulate --constraints s.poly; refused 2 "-o MESH is missing"
run triangulate -o m.off; refused 2 "needs POINTS, .*or --constraints FILE"
run triangulate three.xyz --keep hull -o m.off; refused 2 "need --constraints"
run triangulate three.xyz --split -o m.off; refused 2 "need --constraints"
run triangulate --constraints s.poly --columns x,y -o m.off; refused 2 "need POINTS"
run triangulate --constraints s.poly --limit 7 -o m.off; refused 2 "--limit needs"
run triangulate a b --constraints s.poly -o m.off; refused 2 "expected \[POINTS\]"
run triangulate - --constraints - -o m.off; refused 2 "can be read only once"
run triangulate --constraints absent.poly -o m.off; refused 3 "absent\.poly: No such file"
run triangulate absent.xyz --constraints s.poly -o m.off; refused 3 "absent\.xyz: No such file"
run triangulate --constraints . -o m.off; refused 3 ''
run triangulate --constraints three.xyz -o m.off; refused 3 'three\.xyz'
run triangulate --constraints lake.off -o m.off; refused 3 'lake\.off'
sed 's/^3 6 6/3 6/' s.poly >short.poly
run triangulate --constraints short.poly -o m.off; refused 3 'short\.poly:5: '
printf '2 2 0 0\n1 0 0\n2 1 1\n1 0\n1 1 2\n0\n' >two.poly
run triangulate --constraints two.poly -o m.off; refused 3 'two\.poly: '
printf '3 2 0 0\n1 0 0\n2 1 nan\n3 1 1\n1 0\n1 1 2\n0\n' >bad.poly
run triangulate --constraints bad.poly -o m.off; refused 3 'bad\.poly: .*(not finite|finite)'
run triangulate s.poly --constraints s.poly -o s.poly --format off
refused 2 'is both input and output'
# A .poly may take its points from the .node that would be written.
for out in s.node s.ele ./s.node; do
    run triangulate --constraints s.poly -o $out
    refused 2 's\.poly: .*\.node'
done
run triangulate --constraints s.poly -o s --format node; refused 2 's\.poly: .*\.node'
absent m.off; absent s.node
run triangulate --constraints s.poly -o other.node; exits 0; says_nothing
rm other.node other.ele

# What is kept.
kept() { # kept TRIANGLES AREA FILE OPTIONS...
    local triangles=$1 area=$2
    shift 2
    rm -f k.prj
    run triangulate --constraints "$@" -o k.off; exits 0; says_nothing
    prints_line "^triangles +$triangles\$"
    run info k.off; prints_line "^area +$area\$"
    run check k.off; exits 0
}
kept 8 32 s.poly
kept 8 32 s.poly --keep auto
kept 8 32 s.poly --keep inside
kept 10 36 s.poly --keep hull
run triangulate --constraints s.poly -o k.off
prints_line '^points +8$'; prints_line '^constraints +8$'; prints_line '^pieces +8$'
prints_line '^added +0$'
prints_line '^removed +2$'; prints_line '^crossed +[0-9]+$'
run_on "$square_poly" triangulate --constraints - -o - --format off; exits 0; says '^removed +2$'
holds "standard input and output" same_text "$logs/out" k.off
run triangulate --constraints s.poly -q -o k.off; exits 0; says_nothing; prints ''
# Holes that remove nothing, or too much.
sed '$s/.*/1 77 7/' s.poly >far.poly
run triangulate --constraints far.poly -o k.off; exits 0
says 'far\.poly: warning: 1 of 1 holes remove nothing, the first at \(77, 7\): its point is outside'
run triangulate --constraints far.poly -q -o k.off; exits 0; says_nothing
sed 's/^8 8 5$/8 8 8/' s.poly >gap.poly
run triangulate --constraints gap.poly -o none.off; absent none.off
refused 3 'nothing is left: the point of hole 0 \(3, 3\) reaches all .*; --keep hull keeps all$'
sed 's/^4 4 1$/4 4 4/' s.poly >outer.poly
run triangulate --constraints outer.poly -o none.off; absent none.off
run triangulate --constraints s.poly --json -o k.off; holds "the report is JSON" is_json "$logs/out"
prints_line '"removed": 2'
printf '3 3\n0.5 3\n2 3\n9 9\n' >q.xyz
run locate k.off q.xyz
holds "a hole is a hole" test "$(cut -d, -f3 "$logs/out" | xargs)" == \
    'status hole inside edge outside'
if $geojson; then
    kept 10 33 lake.geojson
    kept 18 36 lake.geojson --keep hull
    gzip -k lake.geojson
    kept 10 33 lake.geojson.gz
    echo '{"type":"LineString","coordinates":[[0,0],[4,0],[4,4]]}' >open.geojson
    run triangulate --constraints open.geojson --keep inside -o none.off
    refused 3 'open\.geojson: nothing is left: .*; --keep hull keeps all$'; absent none.off
    run triangulate --constraints open.geojson --keep hull -o k.off; exits 0
    # lines bound nothing of their own
    printf '{"type":"LineString","coordinates":[[0,0],[4,0],[4,4],[0,0]]}' >line.geojson
    printf '0 4\n' >corner.xyz
    kept 2 16 line.geojson corner.xyz --crs EPSG:4326
    kept 1 8 line.geojson corner.xyz --keep inside --crs EPSG:4326
    printf '{"type":"Polygon",\n"coordinates":[[[0,0],[1,0],[0,0]]]}' >ring.geojson
    run triangulate --constraints ring.geojson -o m.off
    refused 3 'ring\.geojson: warning: feature 0: ring 0 of polygon 0 has fewer than three different points: the polygon is'
    says 'fewer than three points: 0'; absent m.off
    printf '{"type":"Polygon",\n"coordinates":[[[0,0],[1,0}' >syntax.geojson
    run triangulate --constraints syntax.geojson -o m.off; refused 3 'syntax\.geojson:2: '
fi

# Points and constraints together: the points come first, and those of the constraints that repeat
# one are duplicates.
printf '1 1\n5 5\n0 0\n' >p.xyz
run triangulate p.xyz --constraints s.poly -o both.off; exits 0
prints_line '^points +11$'; prints_line '^duplicates +1$'
holds "vertex 1 is point 1" test "$(sed -n 4p both.off)" == '5 5 0'
holds "vertex 5 is the third of s.poly" test "$(sed -n 8p both.off)" == '6 6 0'

# Crossings: an error that names both, or a vertex.
printf '4 2 0 0\n1 0 0\n2 4 4\n3 0 4\n4 4 0\n2 0\n1 1 2\n2 3 4\n0\n' >x.poly
run triangulate --constraints x.poly --keep hull -o m.off
refused 3 'x\.poly: line 7 crosses line 8 near 2 2; --split puts a vertex there$'; absent m.off
run triangulate --constraints x.poly --keep hull --split -o m.off; exits 0; says_nothing
prints_line '^added +1$'; prints_line '^pieces +4$'; prints_line '^triangles +4$'
holds "the vertex comes last" test "$(sed -n 7p m.off)" == '2 2 0'
if $geojson; then
    square() { # square LOW HIGH: a feature
        printf '{"type":"Feature","geometry":{"type":"Polygon","coordinates":'
        printf '[[[%s,%s],[%s,%s],[%s,%s],[%s,%s],[%s,%s]]]}}' "$1" "$1" "$2" "$1" "$2" "$2" "$1" \
            "$2" "$1" "$1"
    }
    echo "{\"type\":\"FeatureCollection\",\"features\":[$(square 20 21),$(square 0 4),$(square 3 6)]}" >parcels.geojson
    run triangulate --constraints parcels.geojson -o x.off
    refused 3 'parcels\.geojson: feature [12] crosses feature [12] near [34] [34]; --split'
    absent x.off
    kept '[0-9]+' 25 parcels.geojson --split
    echo '{"type":"Polygon","coordinates":[[[0,0],[4,4],[4,0],[0,4],[0,0]]]}' >bow.geojson
    run triangulate --constraints bow.geojson -o x.off
    refused 3 'feature 0 crosses itself near 2 2; '
    kept 2 8 bow.geojson --split
fi

# Heights and fields: those of the file; at vertices of constraints without them those of POINTS,
# outside the nearest.
printf 'x,y,z,salt\n0,0,0,1\n8,0,8,1\n8,8,16,3\n0,8,8,3\n' >plane.csv
printf '# attributes: wet\n3 2 1 0\n0 2 2 5\n1 4 2 6\n2 9 4 7\n1 0\n0 0 1\n0\n' >inner.poly
run triangulate plane.csv --constraints inner.poly --keep hull -o plane.node; exits 0; says_nothing
holds "fields of both" test "$(head -n 1 plane.node)" == '# attributes: z, salt, wet'
holds "heights on the plane, at the border outside" \
    test "$(tail -n +3 plane.node | cut -d' ' -f4 | xargs)" == '0 8 16 8 4 6 12'
holds "salt between" test "$(tail -n +3 plane.node | cut -d' ' -f5 | xargs)" == '1 1 3 3 1.5 1.5 2'
holds "wet at its own" test "$(tail -n +3 plane.node | cut -d' ' -f6 | xargs)" == \
    'nan nan nan nan 5 6 7'
# Added vertices: along the constraint where its ends have heights, else on the surface.
if $geojson; then
    lines() { echo "{\"type\":\"MultiLineString\",\"coordinates\":[[$1,$2],[$3,$4]]}"; }
    lines '[2,2,100]' '[6,2,200]' '[5,1]' '[5,3]' >dam.geojson
    run triangulate plane.csv --constraints dam.geojson --split -o dam.off; exits 0
    prints_line '^added +1$'
    holds "heights of a dam" test "$(sed -n '7,11p' dam.off | cut -d' ' -f3 | xargs)" == \
        '100 200 6 8 175'
    lines '[2,2]' '[6,2]' '[5,1]' '[5,3]' >flat.geojson
    run triangulate plane.csv --constraints flat.geojson --split -o dam.off; exits 0
    holds "heights of the surface" test "$(sed -n '7,11p' dam.off | cut -d' ' -f3 | xargs)" == \
        '4 8 6 8 7'
    run triangulate --constraints flat.geojson --split -o dam.off; exits 0
    holds "no heights" test "$(sed -n '3,7p' dam.off | cut -d' ' -f3 | xargs)" == '0 0 0 0 0'
    # Nothing tells the heights: points without, or too few of them for a surface.
    lines '[2,2,3]' '[6,2]' '[5,3]' '[5,4]' >half.geojson
    run triangulate three.xyz --constraints half.geojson -o half.off; exits 0
    holds "heights that are not known" test "$(sed -n '3,9p' half.off | cut -d' ' -f3 | xargs)" == \
        'nan nan nan 3 nan nan nan'
    printf '2 2 1\n6 2 9\n' >pair.xyz
    run triangulate pair.xyz --constraints half.geojson -o half.off; exits 0
    prints_line '^duplicates +2$'
    says '^meshwalk: pair\.xyz: warning: its points lie on one line.*nan$'
    run triangulate pair.xyz --constraints half.geojson -q -o half.off; exits 0; says_nothing
    holds "vertices at one place share heights" \
        test "$(sed -n '3,8p' half.off | cut -d' ' -f3 | xargs)" == '1 9 3 9 nan nan'
fi

# The kinds.
awk 'BEGIN { srand(5); for (i = 0; i < 60; i++) print rand(), rand(), i }' >r.xyz
for kind in delaunay greedy min-weight min-max-angle; do
    run triangulate r.xyz --kind $kind -o r.off; exits 0; says_nothing
    prints_line "^kind +$kind\$"; prints_line '^optimal +yes$'; prints_line '^edge length +[0-9.]+$'
    awk '$1 == "edge" { print $3 }' "$logs/out" >"length.$kind"
    awk '$1 == "largest" && $2 == "angle" { print $3 }' "$logs/out" >"angle.$kind"
    run check r.off; exits 0
done
less() { awk "BEGIN { exit !($(<"$1") <= $(<"$2")) }"; }
for kind in delaunay greedy min-max-angle; do
    holds "min-weight is short" less length.min-weight length.$kind
done
for kind in delaunay greedy min-weight; do
    holds "min-max-angle has small angles" less angle.min-max-angle angle.$kind
done
run triangulate r.xyz --kind min-max-angle --limit 20 -o r.off; exits 0; prints_line '^optimal +no$'
says '^meshwalk: r\.xyz: warning: .*min-max-angle.*local optimum.*--limit'
run triangulate r.xyz --kind min-max-angle --limit 20 -q -o r.off; exits 0; says_nothing; prints ''
awk 'BEGIN { for (i = 0; i < 40; i++) printf "%.9g %.9g\n", cos(i * .157), sin(i * .157) }' \
    >circle.xyz
run triangulate circle.xyz --kind min-weight -o r.off; exits 0; says_nothing
prints_line '^optimal +yes$'
prints_line '^faces +1$'; prints_line '^largest face +40$'; prints_line '^local faces +0$'
run triangulate circle.xyz --kind min-weight --limit 10 -o r.off; exits 0
prints_line '^optimal +no$'
says '^meshwalk: circle\.xyz: warning: .*min-weight.*local optimum: of 1 faces.*40 corners.*--limit'
run triangulate r.xyz --kind min-weight -o r.off --json
holds "the report is JSON" is_json "$logs/out"
prints_line '"largest_face": '
run triangulate r.xyz --limit 20 -o r.off; refused 2 '--limit needs'

# GDAL, where the program has it: curves, layers, polygons with holes, heights.
if $gdal; then
    printf 'name,WKT\na,"POLYGON ((0 0,6 0,6 6,0 6,0 0),(2 2,4 2,4 4,2 4,2 2))"\nb,\nc,"POINT Z (1 1 7)"\n' >wkt.csv
    kept 10 32 wkt.csv
    printf 'id,WKT\n1,"CURVEPOLYGON (CIRCULARSTRING (0 1,1 0,0 -1,-1 0,0 1))"\n' >disc.csv
    run triangulate --constraints disc.csv -o disc.off; exits 0; prints_line '^constraints +90$'
    run info disc.off
    holds "a circle has about its area" awk '$1 == "area" { exit !($2 > 3.13 && $2 < 3.1416) }' \
        "$logs/out"
    printf 'id,WKT\n1,"LINESTRING (0 0,4 4)"\n2,"LINESTRING (0 4,4 0)"\n' >cross.csv
    run triangulate --constraints cross.csv -o m.off
    refused 3 'cross\.csv: feature 0 crosses feature 1 near 2 2; '
    printf 'id,WKT\n1,"LINESTRING (0 0,4 4)"\n2,"LINESTRING (1 1,nan 2)"\n' >nan.csv
    run triangulate --constraints nan.csv -o none.off; refused 3 'nan\.csv: feature 1: GDAL says: .'
    printf 'a,b\n1,2\n' >table.csv
    run triangulate --constraints table.csv -o none.off; refused 3 'no points, lines or polygons'
    absent none.off
    dxf() { # dxf "X Y X Y"...: lines
        printf '0\nSECTION\n2\nENTITIES\n'
        # shellcheck disable=SC2086 # four words
        for line in "$@"; do printf '0\nLINE\n8\n0\n10\n%s\n20\n%s\n11\n%s\n21\n%s\n' $line; done
        printf '0\nENDSEC\n0\nEOF\n'
    }
    dxf '0 0 3 0' '3 0 3 3' '3 3 0 0' '3 3 0 3' >plate.dxf
    kept 2 9 plate.dxf
    # A shapefile: a polygon with a hole.
    perl -e 'sub file { my ($name, $words, $body) = @_; open my $f, ">:raw", $name or die;
        print $f pack("N7 V2 d<8",
        9994, 0, 0, 0, 0, 0, 50 + $words, 1000, 5, 0, 0, 6, 6, 0, 0, 0, 0), $body; }
        my @p = (0,0, 0,6, 6,6, 6,0, 0,0, 2,2, 4,2, 4,4, 2,4, 2,2);
        my $r = pack("V d<4 V4 d<20", 5, 0, 0, 6, 6, 2, 10, 0, 5, @p); my $w = length($r) / 2;
        file("s.shp", $w + 4, pack("N2", 1, $w) . $r); file("s.shx", 4, pack("N2", 50, $w));'
    kept 8 32 s.shp
    if [[ -n ${MW_SHARED:-} && -f $MW_SHARED/domain/wrench.dxf ]]; then
        run triangulate --constraints "$MW_SHARED/domain/wrench.dxf" -o wrench.off; exits 0
        says_nothing
        prints_line '^constraints +[1-9]'
        run check wrench.off; exits 0
    fi
fi

# Real files: what comes out is sound, keeps its constraints apart from the hull, and crossings are
# named.
data=${MW_SHARED:-/nowhere}/domain
for file in "$data"/*.poly "$data"/*.geojson*; do
    [[ -f $file ]] || { left_out "there is no ../shared/data"; continue; }
    [[ $file == *.poly || $geojson == true ]] || continue
    run triangulate --constraints "$file" -q -o real.off
    holds "taken, or refused with a reason" test $code == 0 -o $code == 3
    [[ $code == 0 ]] || says 'crosses .* near .* --split|nothing is left'
    run triangulate --constraints "$file" --split --keep hull -q -o real.off; exits 0; says_nothing
    run check real.off; exits 0
    run info real.off; prints_line '^convex +yes$'
done
# A boundary cuts the triangulation, breaklines included; polygons among the constraints are edges
# then.
for x in 0 1 2 3 4 5; do for y in 0 1 2 3 4 5; do echo "$x $y $((x + y))"; done; done >field.xyz
printf '{"type":"Polygon","coordinates":[[[0.5,0.5],[4.5,0.5],[4.5,4.5],[0.5,4.5],[0.5,0.5]]]}' \
    >edge.json
printf '{"type":"LineString","coordinates":[[-1,2.25],[6,2.25]]}' >break.json
printf '{"type":"Polygon","coordinates":[[[1.2,1.2],[1.8,1.2],[1.8,1.8],[1.2,1.2]]]}' >lake.json
run triangulate field.xyz --boundary edge.json -o cut.ply; exits 0
says '^meshwalk: field\.xyz: 20 of its 36 points lie outside of the polygons in edge\.json'
run info cut.ply; prints_line '^area +16$'; prints_line '^holes +0$'; prints_line '^embedding +yes$'
run_on $'0.6 0.6\n0.5 4.5\n0.4 2\n' sample cut.ply -; exits 0
prints $'x,y,z\n0.6,0.6,1.2\n0.5,4.5,5\n0.4,2,'
run triangulate field.xyz --boundary edge.json --constraints break.json -o cut.ply; exits 0
prints_line '^added +2$'
run info cut.ply; prints_line '^area +16$'
run triangulate field.xyz --boundary edge.json --constraints lake.json -o cut.ply; exits 0
run info cut.ply; prints_line '^area +16$'
run triangulate --boundary edge.json -o cut.off; exits 0; run info cut.off; prints_line '^area +16$'
run triangulate field.xyz --boundary edge.json --max-edge 0.1 -o cut.off; exits 0
prints_line '^peeled +0$'
run triangulate field.xyz --boundary break.json -o no.off
refused 3 'break\.json: holds no polygon, so it is no boundary'
run triangulate field.xyz --boundary edge.json --keep hull -o no.off; refused 2 '--keep cannot'
run triangulate field.xyz --boundary edge.json --kind greedy -o no.off
refused 2 '--boundary are for --kind delaunay'
run triangulate field.xyz --boundary absent.json -o no.off; refused 3 'absent\.json'
run triangulate - --boundary - -o no.off; refused 2 'can be read only once'
absent no.off

# A polygon that leaves out most points is remarked on.
for x in 0 1 2 3 4 5; do for y in 0 1 2 3 4 5; do echo "$x $y 1"; done; done >many.xyz
printf '{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]]]}' >small.json
run triangulate many.xyz --constraints small.json -o small.off; exits 0
says '^meshwalk: many\.xyz: 27 of its 36 points lie outside of the polygons in small\.json.*--keep hull'
run triangulate many.xyz --constraints small.json --keep hull --crs EPSG:4326 -o small.off; exits 0
says_nothing
# A vertex where two lines cross gets its height from the lower-numbered of the two lines.
printf 'x,y,z\n-9,-9,0\n9,-9,0\n9,9,0\n-9,9,0\n' >corners.csv
line() { # line "POSITION, POSITION": a feature with a line
    echo "{\"type\": \"Feature\", \"geometry\": {\"type\": \"LineString\", \"coordinates\": [$1]}}"
}
echo "{\"type\": \"FeatureCollection\", \"features\": [$(line '[-8, 8, 100], [-6, 8, 100]'),
    $(line '[0, 0, 10], [4, 0, 14]'), $(line '[1, -1, 50], [1, 1, 50]'),
    $(line '[3, -1, 60], [3, 1, 60]')]}" >crossed.geojson
run triangulate -q corners.csv --constraints crossed.geojson --split -o crossed.off; exits 0
holds "both crossings are along the second line" test \
    "$(sed -n 3,16p crossed.off | grep -E '^[13] 0 ' | sort | xargs)" == '1 0 11 3 0 13'
finish
