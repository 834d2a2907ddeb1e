#!/usr/bin/env bash
# A triangulation of points from vector files, by GDAL: heights, fields, layers, conditions,
# coordinate systems, what is refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# LeakSanitizer stops all threads when the program ends, and sometimes crashes over those of GDAL,
# which end at that time.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

feature() { printf '{"type":"Feature","properties":%s,"geometry":%s}' "$1" "$2"; }
point() { printf '{"type":"Point","coordinates":[%s]}' "$1"; }
collection() { local IFS=,; printf '{"type":"FeatureCollection","features":[%s]}\n' "$*"; }
run_on $'x,y\n0,0\n1,0\n0,1\n' triangulate - -o out.off --layer a
refused 2 "standard input: option '--layer' is for files that GDAL reads"
run_on $'x,y\n0,0\n1,0\n0,1\n' triangulate - -o out.off --where a
refused 2 "'--where' is for files that GDAL reads"
run triangulate --layer a --constraints a.geojson -o out.off
refused 2 'need POINTS, which are missing'
collection "$(feature '{"elev":5}' "$(point 0,0)")" "$(feature '{"elev":6}' "$(point 1,0)")" \
    "$(feature '{"elev":7.5}' "$(point 1,1)")" "$(feature '{}' "$(point 0,1)")" >plain.geojson
run triangulate plain.geojson -o out.off
if grep -Eq 'built with GDAL|cannot be loaded' "$logs/err"; then
    refused 3 'plain\.geojson: '
    finish
fi
exits 0
prints_line '^heights +elev$'
holds "missing heights stay missing" grep -qx '0 1 nan' out.off

# The same mesh as of the table, whatever the format, and with heights as z or as an attribute.
cat >wells.csv <<'END'
name,code,x,y,elev,depth,when
B1,07,7000.5,1000,2.25,10,2020-01-01
B2,08,7001.25,1000,3,,
B3,09,7001,1001.5,-4.5,12.5,
B4,10,7000,1002,5e-3,NA,
B5,11,7003,1001,6,13,
END
run triangulate wells.csv -o table.ply --crs EPSG:32610; exits 0
run triangulate -q wells.csv -o table.off; exits 0
for ending in gpkg shp geojson geojsonl fgb; do
    run locate -q table.ply wells.csv -o in.$ending; exits 0
    run triangulate -q in.$ending -o out.off --columns x,y,elev; exits 0
    case $ending in
        fgb | geojson*) ;; # another order; fewer digits
        *) holds "$ending: the mesh of the table" same_text table.off out.off ;;
    esac
    run triangulate in.$ending -o out.ply; exits 0; prints_line '^heights +elev$'
    holds "$ending: the coordinate system" grep -aqE '^comment crs' out.ply
    prints_line '^fields .*code, .*depth'
    says "column.* 'name'.* become.* no field.*: texts stand there, the first in feature [01]$"
done
run triangulate in.gpkg -o out.off --where 'depth > 0' -q; exits 0
holds "three of the points" grep -qx '3 1 0' out.off

# z of the geometry, points in multipoints, numbers that are texts, heights that are made up.
many='{"type":"MultiPoint","coordinates":[[0,0,3],[1,0,4]]}'
collection "$(feature '{"h":"1,5","n":1}' "$many")" \
    "$(feature '{"h":"2","n":2}' "$(point 0,1,5)")" >multi.geojson
run triangulate multi.geojson -o out.off; exits 0; prints_line '^points +3$'
prints_line '^heights +z$'; prints_line '^fields +n$'
says "column 'h' becomes no field: texts stand there, the first in feature 0"
holds "z of each point" grep -qx '1 0 4' out.off
run triangulate multi.geojson -o out.off --columns x,y,h
refused 3 "multi\.geojson: feature 0: column 'h', the height, has no number there"
sed -i 's/"1,5"/" -1.5"/' multi.geojson
run triangulate multi.geojson -o out.off --columns X,y,h,N; exits 0; prints_line '^heights +h$'
prints_line '^fields +n$'
holds "numbers as texts" grep -qx '1 0 -1.5' out.off
run triangulate multi.geojson -o out.off --columns 1,2,3; exits 0; prints_line '^heights +z$'
run triangulate multi.geojson -o out.off --columns y,x; refused 3 "'y' is where x or y should be"
run triangulate multi.geojson -o out.off --columns x,y,m; refused 3 "'m' is not a column"
run triangulate multi.geojson -o out.off --columns x,y,h,h; refused 3 "'h' is named twice"
run triangulate multi.geojson -o out.off --columns x; refused 3 "'x' is only one column"
run triangulate multi.geojson -o out.off --class ground; refused 2 "'--class' is for LAS"
collection "$(feature '{"elev":5}' "$(point 0,0,0)")" "$(feature '{"elev":6}' "$(point 1,0,0)")" \
    "$(feature '{"elev":7}' "$(point 1,1,0)")" >zero.geojson
run triangulate zero.geojson -o out.off; exits 0
says "zero\.geojson: warning: the heights of its points are all 0; --columns x,y,elev takes those of 'elev'"

# What is no point.
collection "$(feature '{}' "$(point 0,0)")" "$(feature '{"n":1}' null)" >none.geojson
run triangulate none.geojson -o out.ply
refused 3 'none\.geojson: feature 1 has no point; --where chooses those that have'
collection "$(feature '{}' "$(point 0,0)")" \
    "$(feature '{}' '{"type":"LineString","coordinates":[[0,0],[1,1]]}')" >line.geojson
run triangulate line.geojson -o out.ply
refused 3 'line\.geojson: feature 1 is a LINESTRING, not a point'
run triangulate none.geojson -o out.ply --layer a; refused 3 "has no layer 'a'; it has: none"
run triangulate zero.geojson -o out.ply --where 'm = 3'
refused 2 "'--where' is not a valid condition"
cat >tracks.gpx <<'END'
<?xml version="1.0"?>
<gpx version="1.1" creator="t" xmlns="http://www.topografix.com/GPX/1/1">
<wpt lat="1" lon="7"><ele>12.5</ele></wpt><wpt lat="1" lon="8"><ele>13</ele></wpt><wpt lat="2" lon="7"><ele>14</ele></wpt>
<trk><trkseg><trkpt lat="0" lon="1"/><trkpt lat="1" lon="1"/></trkseg></trk>
</gpx>
END
run triangulate tracks.gpx -o out.ply; refused 2 'tracks\.gpx: which layer has the points\?'
run triangulate tracks.gpx --layer waypoints -o out.ply; exits 0; prints_line '^heights +ele$'
holds "the coordinate system is kept" grep -aq '^comment crs .*WGS 84' out.ply
absent wells.parquet
run --version
if grep -q 'GDAL.*not .*Parquet' "$logs/out"; then
    run triangulate absent.parquet -o out.ply
    refused 3 'absent\.parquet: this GDAL has no driver for Parquet'
    run triangulate wells.csv --constraints absent.feather -o out.ply
    refused 3 'absent\.feather: this GDAL has no driver for Arrow'
    run sample absent.off absent.parquet
    refused 3 'absent\.parquet: this GDAL has no driver for Parquet'
fi

# Heights are not transformed, and are said to be where that matters.
heights() {
    run triangulate wells.csv --points-crs "$1" --crs "$2" -o out.ply; exits 0
    if [[ $3 ]]; then says "$3"; else holds "no word of heights" test -z \
        "$(grep 'not transformed' "$logs/err")"; fi
}
heights EPSG:32610 EPSG:32611 ''
heights EPSG:32610+5703 EPSG:32611+5703 ''
heights EPSG:32610+5703 EPSG:32610+6360 \
    "wells\.csv: warning: heights are not transformed: they stay 'NAVD88 height' in metre, but heights in .* are 'NAVD88 height \(ftUS\)' in US survey foot"
heights EPSG:32610+5703 EPSG:32611 \
    "stay 'NAVD88 height' in metre; EPSG:32611 .* does not define heights"
heights EPSG:32610 EPSG:32611+5703 \
    "EPSG:32610 .* does not define them; heights in .* are 'NAVD88 height' in metre"
heights EPSG:32610 EPSG:2992 \
    'they stay in metre if that is their unit, as it is of x and y in EPSG:32610 .*; the unit of EPSG:2992 .* is foot'
run triangulate wells.csv --crs EPSG:32610+6360 -o feet.ply; exits 0
run sample feet.ply wells.csv --points-crs EPSG:32611; exits 0
says "feet\.ply: warning: heights are not transformed: they stay 'NAVD88 height \(ftUS\)'"
run locate feet.ply wells.csv --points-crs EPSG:32611; exits 0
holds "no word of heights" test -z "$(grep 'not transformed' "$logs/err")"
finish
