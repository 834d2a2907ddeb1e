#!/usr/bin/env bash
# profile: heights along lines, with every crossing; gaps, corners, attributes, vector files.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

# A square of two triangles, a gap, and one more triangle.
cat >gap.off <<'END'
OFF
6 3 0
0 0 10
4 0 20
4 4 30
0 4 20
8 0 40
8 4 50
3 0 1 2
3 0 2 3
3 4 5 2
END
header=feature,part,chainage,x,y,z,triangle,at
run_on $'x,y\n1,2\n7,2\n9,3\n' profile gap.off -; exits 0; says_nothing
prints "$header
0,0,0,1,2,17.5,1,begin
0,0,1,2,2,20,0,edge
0,0,3,4,2,25,-1,edge
0,0,5,6,2,35,2,edge
0,0,6,7,2,40,2,corner
0,0,7.118033988749895,8,2.5,46.25,-1,edge
0,0,8.23606797749979,9,3,,-1,end"
cp "$logs/out" expected
run_on $'x,y\n1,2\n7,2\n9,3\n' profile --threads 1 --strict gap.off -; exits 1
prints "$(<expected)"
# A point that is there twice, and columns by name.
run_on $'east;north\n1;2\n7;2\n7;2\n9;3\n' profile --columns east,north gap.off -; exits 0
prints "$(<expected)"

# A mesh that is no embedding is refused; no option of this command accepts it.
printf '%s\n' "$overlap" >overlap.off
run_on $'x,y\n1,2\n7,2\n' profile overlap.off -; refused 3 'overlap\.off: '
says "'meshwalk check overlap\.off' .*--fix mends some"
holds "--any is not offered" test -z "$(grep -e --any "$logs/err")"

# What else a table tells of its points is not kept, and that is said.
run_on $'name,x,y,m\na,1,2,0\nb,7,2,1\nc,9,3,2\n' profile gap.off -; exits 0
prints "$(<expected)"
says 'standard input: remark: .*columns name, m$'
run_on $'5 1 2\n6 7 2\n7 9 3\n' profile --columns 2,3 gap.off -; exits 0; prints "$(<expected)"
says 'columns 1$'

# Through vertices, along edges and the border, touching a corner, outside, on one point.
run_on $'x,y\n0,4\n4,0\n' profile gap.off -; exits 0
prints "$header
0,0,0,0,4,20,1,begin
0,0,2.8284271247461903,2,2,20,0,edge
0,0,5.656854249492381,4,0,20,-1,end"
run_on $'x,y\n-1,-1\n5,5\n' profile gap.off -; exits 0
prints "$header
0,0,0,-1,-1,,-1,begin
0,0,1.414213562373095,0,0,10,0,vertex
0,0,7.071067811865475,4,4,30,-1,vertex
0,0,8.48528137423857,5,5,,-1,end"
run_on $'x,y\n0,4\n8,4\n' profile gap.off -; exits 0
prints "$header
0,0,0,0,4,20,1,begin
0,0,4,4,4,30,2,vertex
0,0,8,8,4,50,-1,end"
run_on $'x,y\n-1,1\n1,-1\n' profile gap.off -; exits 0
prints "$header
0,0,0,-1,1,,-1,begin
0,0,2.8284271247461903,1,-1,,-1,end"
run_on $'x,y\n1,1\n1,1\n' profile gap.off -; exits 0
prints "$header
0,0,0,1,1,15,0,begin
0,0,0,1,1,15,-1,end"

# Features: parts, attributes, names that clash; a feature without a geometry counts.
cat >roads.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"Main, street","lanes":2,"Z":0.5},"geometry":{"type":"LineString","coordinates":[[1,2],[3,2]]}},
{"type":"Feature","properties":{"name":null,"lanes":null,"Z":null},"geometry":null},
{"type":"Feature","properties":{"name":"x","lanes":3,"Z":1},"geometry":{"type":"MultiLineString","coordinates":[[[0,0],[4,4]],[[5,1],[6,1]]]}}]}
END
gzip -c roads.geojson >packed.geojson.gz
run profile gap.off packed.geojson.gz; exits 0
says 'packed\.geojson\.gz: remark: 1 of 3 features without a line or polygon is skipped .*: 1$'
printf '%s\n' '{"type":"FeatureCollection","features":[' >several.geojson
for part in '"Point","coordinates":[1,1]' '"LineString","coordinates":[[1,2],[3,2]]' \
    '"LineString","coordinates":[]' '"Polygon","coordinates":[[[1,1],[2,2],[1,1]]]'; do
    printf '{"type":"Feature","properties":{},"geometry":{"type":%s}},\n' "$part" >>several.geojson
done
printf '%s\n' '{"type":"Feature","properties":{},"geometry":null}]}' >>several.geojson
run profile --field z gap.off several.geojson; exits 0
says 'remark: 3 of 5 features without a line or polygon are skipped .*: 0, 2, 4$'
says 'feature 3: ring 0 of polygon 0 has fewer than three different points'
run drape gap.off several.geojson; exits 0
says 'remark: 3 of 5 features without a line or polygon are skipped .*: 0, 2, 4$'
run profile -q gap.off several.geojson; exits 0; says_nothing
if "$meshwalk" --version | grep -q 'GDAL .*found'; then
    run profile -q gap.off roads.geojson; exits 0; says_nothing
    prints "feature,part,name,lanes,line_Z,chainage,x,y,z,triangle,at
0,0,\"Main, street\",2,0.5,0,1,2,17.5,1,begin
0,0,\"Main, street\",2,0.5,1,2,2,20,0,edge
0,0,\"Main, street\",2,0.5,2,3,2,22.5,-1,end
2,0,x,3,1,0,0,0,10,0,begin
2,0,x,3,1,5.656854249492381,4,4,30,-1,end
2,1,x,3,1,0,5,1,,-1,begin
2,1,x,3,1,1,6,1,,-1,end"
    run profile gap.off roads.geojson; exits 0
    says 'roads\.geojson: remark: 1 of 3 features without a line or polygon is skipped .*: 1$'
    run profile -q --attribute lanes gap.off roads.geojson; exits 0
    prints_line '^2,1,3,1,6,1,,-1,end$'
    run profile -q --attribute width gap.off roads.geojson
    refused 3 "has no attribute 'width'; it has: name, lanes, Z"
    for ending in gpkg shp fgb geojson; do
        run profile -q gap.off roads.geojson -o points.$ending; exits 0; says_nothing
        run info --json points.$ending
        run locate -q gap.off points.$ending; exits 0
        checks=$((checks + 1))
        [[ $(wc -l <"$logs/out") == 8 ]] || fail "points.$ending should have 7 points"
        prints_line 'Main, street.*,17.5,.*inside,1,'
    done
    # Longitudes and latitudes over a mesh in Swiss coordinates.
    printf '%s\n' OFF '4 2 0' '2600000 1200000 10' '2601000 1200000 20' '2601000 1201000 30' \
        '2600000 1201000 20' '3 0 1 2' '3 0 2 3' >berne.off
    run_on $'lon,lat\n7.44,46.955\n7.449,46.955\n' profile --crs EPSG:2056 berne.off - -q; exits 0
    prints_line '^0,0,0,2600104[.].*,1,begin$'
    run_on $'x,y\n2600100,1200500\n2600900,1200500\n' profile --crs EPSG:2056 --lines-crs same \
        berne.off - -q; exits 0
    prints_line '^0,0,400,2600500,1200500,20,0,edge$'
    run_on $'x,y\n0,0\n1,1\n' profile --crs EPSG:4326 gap.off -; exits 0
    says 'warning: .*chainages are in degrees'
else
    left_out 'GDAL is not found'
fi

# Attributes that are not read are told.
if command -v gzip >/dev/null && "$meshwalk" --version | grep -q 'Jansson *[0-9]'; then
    gzip -k roads.geojson
    run profile --lines-crs same gap.off roads.geojson.gz; exits 0
    prints_line '^2,0,5[.]656854249492381,4,4,30,-1,end$'
    says 'roads.geojson.gz: remark: its attributes are not read'
fi
# As far apart as doubles are.
run_on $'x,y\n-1.7e308,1.7e308\n1.7e308,1.7e308\n' profile gap.off -; exits 0
prints_line '^0,0,inf,1.7e[+]308,1.7e[+]308,,-1,end$'

# Segments of a .poly are lines.
printf '3 2 0 0\n1 1 2\n2 3 2\n3 9 9\n2 0\n1 1 2\n2 2 3\n0\n' >lines.poly
run profile -q gap.off lines.poly; exits 0; prints_line '^[0-9]+,0,1,2,2,20,0,edge$'

# What is refused.
run_on $'x,y\n1,1\n,2\n' profile gap.off -
refused 3 'standard input: point 2 of the line has no finite x and y'
run_on $'x,y\n' profile gap.off -; refused 3 'standard input: there are no lines in it'
run_on $'x,y\n1,1\n2,2\n' profile --field depth gap.off -; refused 3 "has no field 'depth'"
run_on $'x,y\n1,1\n2,2\n' profile --attribute name gap.off -
refused 2 "'--attribute' is for vector"
run profile gap.off roads.geojson --columns 1,2; refused 2 "'--columns' is for a table"
run profile gap.off absent.csv; refused 3 'absent.csv: No such file'
# The length of a line may be too large for a double; those up to its crossings are not.
run_on $'x,y\n1e308,1\n-1e308,1\n' profile gap.off -; exits 0
prints_line '^0,0,1e[+]308,4,1,.*,edge$'
prints_line '^0,0,inf,-1e[+]308,1,,-1,end$'

run profile gap.off; refused 2 ''
run_on $'x,y\n1,1\n2,2\n' profile gap.off - -o gap.off; refused 2 'gap.off'
printf '%s\n' OFF '4 2 0' '0 0 0' '4 0 0' '4 4 0' '3 1 0' '3 0 1 2' '3 0 1 3' >folded.off
run_on $'x,y\n1,1\n2,2\n' profile folded.off -; refused 3 'check folded.off. lists every defect'
finish
