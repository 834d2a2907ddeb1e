#!/usr/bin/env bash
# drape: lines and polygons on a mesh: every crossing, gaps, lengths and areas, vector files.
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
header=feature,part,piece,length,surface_length,x,y,z
run_on $'x,y\n1,2\n7,2\n9,3\n' drape gap.off -; exits 0
says '^meshwalk: standard input: remark: lines outside the mesh in part, which is left out: 1$'
prints "$header
0,0,0,3,8.077747210701755,1,2,17.5
0,0,0,3,8.077747210701755,2,2,20
0,0,0,3,8.077747210701755,4,2,25
0,0,1,2.118033988749895,11.448232063192933,6,2,35
0,0,1,2.118033988749895,11.448232063192933,7,2,40
0,0,1,2.118033988749895,11.448232063192933,8,2.5,46.25"
run_on $'x,y\n1,2\n7,2\n9,3\n' drape gap.off - --strict -q; exits 1; says_nothing
# Through vertices and along an edge, with no gap.
run_on $'x,y\n0,4\n4,0\n4,4\n' drape gap.off - --strict; exits 0; says_nothing
prints_line '^0,0,0,9.65685424949238,[0-9.]+,2,2,20$'
prints_line '^0,0,0,9.65685424949238,[0-9.]+,4,0,20$'
run_on $'x,y\n5,0\n5,9\n' drape gap.off -; exits 0; prints_line ',5,[0-9.]+,[0-9.]+$'
run_on $'x,y\n-5,0\n-5,9\n' drape gap.off -; exits 0; prints "$header"
says 'standard input: warning: lines outside the mesh, which are left out: 1'
run_on $'x,y\n1,1\n1,1\n' drape gap.off - --strict; exits 0; prints "$header"
says '^meshwalk: standard input: remark: lines whose points are all equal, which are left out: 1$'
holds 'and no warning' test -z "$(grep warning "$logs/err")"
# A vertex without a height.
sed 's/^0 4 20/0 4 nan/' gap.off >missing.off
run_on $'x,y\n0.5,2\n3,2\n' drape missing.off -; exits 0
prints_line '^0,0,0,1,[0-9.]+,2,2,20$'
run_on $'x,y\n1,2\n' drape gap.off -; exits 3

run drape gap.off absent.csv; refused 3 'absent.csv'
run_on $'x,y\n1,2\n7,2\n' drape gap.off - --outside-z low
refused 2 "'--outside-z' must be a number"
run_on $'x,y\n1,2\n7,2\n' drape gap.off - --field depth; refused 3 "has no field 'depth'"

if ! "$meshwalk" --version | grep -q 'GDAL .*found'; then finish; fi

cat >parcels.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"holed","area":3},"geometry":{"type":"Polygon",
"coordinates":[[[1,0.5],[3,0.5],[3,3],[1,3],[1,0.5]],[[1.5,1.5],[2,1.5],[2,2],[1.5,1.5]]]}},
{"type":"Feature","properties":{"name":"gap","area":4},"geometry":{"type":"MultiPolygon",
"coordinates":[[[[3,1],[7,1],[7,2],[3,2],[3,1]]],[[[0,3],[1,3],[0,4],[0,3]]]]}},
{"type":"Feature","properties":{"name":"bow","area":4},"geometry":{"type":"Polygon",
"coordinates":[[[1,1],[2,2],[2,1],[1,2],[1,1]]]}}]}
END
run drape gap.off parcels.geojson --lines-crs same -o out.geojson; exits 0; prints ''
says 'parcels.geojson: remark: polygons outside the mesh in part: 1$'
says 'warning: polygons without an area, or with rings that cross, whose areas are not known: 1$'
cp out.geojson "$logs/out"
holds 'none is outside as a whole' test -z "$(grep 'polygons outside the mesh: ' "$logs/err")"
# The slope is (2.5, 2.5) everywhere: areas are sqrt(13.5) times those of the plane.
prints_line '"name": "holed", "line_area": 3, .*"area": 4.875, "surface_area": 17.91[0-9]*, "outside_area": 0'
prints_line '\[ 3.0, 0.5, 18.75 \], \[ 3.0, 3.0, 25.0 \], \[ 1.0, 3.0, 20.0 \], \[ 1.0, 1.0, 15.0 \], \[ 1.0, 0.5, 13.75 \]'
prints_line '\[ 3.0, 1.0, 20.0 \], \[ 4.0, 1.0, 22.5 \], \[ 7.0, 1.0, 37.5 \], \[ 7.0, 2.0, 40.0 \]'
prints_line '"feature": 1, "part": 0,.*"area": 1.5, .*"outside_area": 2.5'
prints_line '"feature": 1, "part": 1,.*"area": 0.5, "surface_area": 1.837'
prints_line '"name": "bow".*"area": null, "surface_area": null'
cat >outside.geojson <<'END'
{"type":"Polygon","coordinates":[[[-1,1],[1,2],[-1,2],[-1,1]]]}
END
run drape gap.off outside.geojson --lines-crs same --outside-z 5 -o out.geojson -q; exits 0
says_nothing
cp out.geojson "$logs/out"
prints_line '\[ -1.0, 1.0, 5.0 \], \[ 0.0, 1.5, 13.75 \], \[ 1.0, 2.0, 17.5 \]'
run drape gap.off parcels.geojson --lines-crs same -o out.geojson -q --strict; exits 1
# Of two polygons one lies in the mesh, the other beside it.
cat >two.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
[[[1,1],[2,1],[2,2],[1,1]]]}},{"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[-3,1],[-2,1],[-2,2],[-3,1]]]}}]}
END
run drape gap.off two.geojson --lines-crs same -o two_out.geojson; exits 0
says 'two.geojson: warning: polygons outside the mesh: 1$'
holds 'no more is said' test "$(wc -l <"$logs/err")" == 1
run drape gap.off parcels.geojson -o out.csv; refused 2 'polygons need a vector file as output'

# Lines in a vector file, one for each piece, with attributes; systems are transformed.
cat >road.geojson <<'END'
{"type":"Feature","properties":{"name":"road","length":7},"geometry":{"type":"LineString",
"coordinates":[[1,2],[7,2]]}}
END
run drape gap.off road.geojson --lines-crs same -o road.gpkg -q; exits 0; says_nothing
if command -v ogrinfo >/dev/null; then
    ogrinfo -al road.gpkg >"$logs/out"
    prints_line '^Geometry: 3D Line String$'; prints_line '^Feature Count: 2$'
    prints_line 'LINESTRING Z \(1 2 17.5,2 2 20,4 2 25\)'; prints_line '^  line_length .* = 7$'
    prints_line '^  surface_length .* = 8.0777'
fi
run drape gap.off road.geojson --crs EPSG:3857 -o road2.geojson -q; exits 0
run drape gap.off road.geojson --lines-crs same -o none/road.gpkg; refused 4 'none/road.gpkg'

# Attributes whose names are those of columns; x, y and z are columns of a table only.
cat >names.geojson <<'END'
{"type":"Feature","properties":{"Feature":1,"part":2,"piece":3,"LENGTH":4,"surface_length":5,"x":6,
"y":7,"Z":8,"area":9,"name":"road"},"geometry":{"type":"LineString","coordinates":[[1,2],[2,2]]}}
END
run drape gap.off names.geojson --lines-crs same -q; exits 0
prints_line '^feature,part,line_Feature,line_part,line_piece,line_LENGTH,line_surface_length,line_x,line_y,line_Z,area,name,piece,length,surface_length,x,y,z$'
prints_line '^0,0,1,2,3,4,5,6,7,8,9,road,0,1,[0-9.]+,1,2,17.5$'
run drape gap.off names.geojson --lines-crs same -q -o names_out.geojson; exits 0
cp names_out.geojson "$logs/out"
prints_line '"line_LENGTH": 4, "line_surface_length": 5, "x": 6, "y": 7, "Z": 8, "area": 9'
cat >both.geojson <<'END'
{"type":"GeometryCollection","geometries":[{"type":"LineString","coordinates":[[1,2],[2,2]]},
{"type":"Polygon","coordinates":[[[1,1],[2,2],[2,1],[1,1]]]}]}
END
run drape gap.off both.geojson --lines-crs same -q; refused 3 'has both lines and polygons'
finish
