#!/usr/bin/env bash
# Rings of fewer than three different points: skipped with a warning that names them, or refused
# with --strict.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
outer='[[0,0],[9,0],[9,9],[0,9],[0,0]]'
cat >rings.geojson <<GEOJSON
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[$outer,[[5,5],[5,5]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"MultiPolygon","coordinates":[[[[2,2],[3,3],[2,2]],[[2,2],[3,2],[3,3]]]]}}]}
GEOJSON
printf '{"type":"Polygon","coordinates":[%s]}\n' "$outer" >sound.geojson

expect_rings() { # expect_rings FILE: what is said of the two rings of the files here
    exits 0
    says "^meshwalk: $1: warning: feature 0: ring 1 of polygon 0 has fewer than three different points: it is skipped$"
    says "^meshwalk: $1: warning: feature 1: ring 0 of polygon 0 has fewer than three different points: the polygon is skipped$"
}
run triangulate --constraints rings.geojson -o m.off
if ! grep -q 'built without Jansson' "$logs/err"; then
    expect_rings rings.geojson; prints_line '^triangles +2$'; prints_line '^constraints +4$'
    run triangulate --constraints rings.geojson --split -o m.off; expect_rings rings.geojson
    run triangulate --constraints rings.geojson -q -o m.off; exits 0; says_nothing
    run edit m.off /dev/null --constraints rings.geojson -o e.off; expect_rings rings.geojson
    run edit m.off /dev/null --constraints rings.geojson -q -o e.off; exits 0; says_nothing
    rm m.off
    run triangulate --constraints rings.geojson --strict -o m.off
    refused 3 'rings.geojson: feature 0: ring 1 of polygon 0 has fewer than three different points, which --strict refuses$'
    absent m.off
    run triangulate --constraints rings.geojson --strict -q -o m.off
    refused 3 'which --strict refuses$'
    run triangulate --constraints sound.geojson --strict -o m.off; exits 0; says_nothing
    # Of many the first are named.
    { printf '{"type":"Polygon","coordinates":[%s' "$outer"; for _ in {1..15}; do printf \
        ',[[5,5]]'; done; echo ']}'; } >many.geojson
    run triangulate --constraints many.geojson -o m.off; exits 0
    says '^meshwalk: many\.geojson: warning: 5 more such rings are skipped$'
    holds "ten are named" test "$(grep -c 'of polygon 0 has fewer' "$logs/err")" == 10
fi
run triangulate many.xyz --strict -o m.off
refused 2 '--keep, --split and --strict need --constraints'

# The same by GDAL, from another format.
cat >rings.csv <<'CSV'
id,WKT
1,"POLYGON((0 0,9 0,9 9,0 9,0 0),(5 5,5 5))"
2,"MULTIPOLYGON(((2 2,3 3,2 2),(2 2,3 2,3 3,2 2)))"
CSV
run triangulate --constraints rings.csv -o m.off
if ! grep -Eq 'built with(out)? GDAL|cannot be loaded' "$logs/err"; then
    expect_rings rings.csv; prints_line '^triangles +2$'; prints_line '^constraints +4$'
    run triangulate --constraints rings.csv --strict -o n.off
    refused 3 'rings.csv: feature 0: ring 1 of polygon 0 .*, which --strict refuses$'; absent n.off
fi
finish
