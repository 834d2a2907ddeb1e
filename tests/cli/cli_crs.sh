#!/usr/bin/env bash
# Coordinate systems: where meshes and points tell theirs, and what keeps it.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

# A comment of PLY, and .prj files beside: kept by what writes meshes.
printf '%s\n' "$square" >square.off
run info square.off; exits 0; prints_line '^crs +not known$'
run info --json square.off; exits 0; prints_line '"crs": null'
echo 'EPSG:2056' >square.prj
run info --json square.off; exits 0; prints_line '"crs": "EPSG:2056"'
echo 'move 0 0.1 0.1' >edits.txt
run edit -q square.off edits.txt -o edited.ply; exits 0
run info --as surface edited.ply; exits 0; prints_line '^crs +EPSG:2056$'
printf 'x,y,z\n0,0,1\n1,0,2\n0,1,3\n' >points.csv
run triangulate -q points.csv -o points.ply; exits 0
run info points.ply; prints_line '^crs +not known$'
echo 'PROJCS["some grid", UNIT["metre", 1]]' >points.prj
run triangulate -q points.csv -o points.ply; exits 0
run info points.ply; prints_line '^crs +PROJCS\["some grid", UNIT\["metre", 1\]\]$'

# A system that another file of the same stem has is not overwritten, and none is written twice.
run triangulate -q points.csv -o points.ply; exits 0
rm points.prj
run triangulate -q points.csv -o points.off; exits 0; absent points.prj
echo 'EPSG:2056' >points.prj
run triangulate points.csv -o points.off; exits 0
holds "the .prj is as it was" test "$(<points.prj)" == EPSG:2056
rm points.off
run edit -q points.ply edits.txt -o points.off
refused 4 'points\.off: is in some grid, but points\.prj, which is there already, says EPSG:2056'
absent points.off
echo beside >points.shp
echo OFF >points.off
run edit -q points.ply edits.txt -o points.off; exits 4
rm points.shp
run edit -q points.ply edits.txt -o points.off; exits 0
holds "beside OFF" test "$(<points.prj)" == 'PROJCS["some grid", UNIT["metre", 1]]'
rm points.off points.prj
run_on "$square" edit - edits.txt -o lone.off; exits 0; says_nothing; absent lone.prj
echo 'EPSG:2056' >lone.prj
run_on "$square" edit - edits.txt -o lone.off; exits 0
says 'lone\.off: warning: its coordinate system is not known, and lone\.prj beside it says EPSG:2056'

# What options say.
echo x,y >none.csv
for option in crs points-crs; do
    for crs in 2056 EPSG: EPSG:2056/.. points.csv ./points.csv /etc/passwd http://127.0.0.1/ \
        'a b'; do
        run locate --$option "$crs" absent.off absent.csv
        refused 2 "option '--$option' must be a coordinate system, as EPSG:2056 or WKT, not '"
    done
done
run locate edited.ply none.csv; exits 0
says 'none\.csv: warning: its coordinate system is not known, and edited\.ply is in EPSG:2056'
run locate -q edited.ply none.csv; exits 0; says_nothing
run locate --points-crs same edited.ply none.csv; exits 0; says_nothing
run locate --crs EPSG:2056 --points-crs EPSG:2056 edited.ply none.csv; exits 0; says_nothing
printf 'comment crs EPSG:2056\n' | sed -i '2r /dev/stdin' edited.ply # another; the first counts
cp edited.ply noise.ply
sed -i '0,/EPSG:2056/s//EPSG:99/' noise.ply
if [[ $("$meshwalk" locate --points-crs EPSG:3857 noise.ply none.csv 2>&1) != *GDAL* ]]; then
    run locate noise.ply none.csv; exits 0
    says 'noise\.ply: warning: its coordinate system is not understood: EPSG:99$'
fi

# Points in another system are transformed. The mesh: a square of 100 m about the old observatory of
# Berne.
printf '%s\n' OFF '4 2 0' '2599950 1199950 0' '2600050 1199950 100' '2600050 1200050 200' \
    '2599950 1200050 100' '3 0 1 2' \
    '3 0 2 3' >berne.off
echo EPSG:2056 >berne.prj
printf '%s\n' id,lon,lat 'a,7.438632421,46.951082725' 'b,NA,46' 'c,0,46' 'd,7.438632421,1e300' \
    >gps.csv
run sample --status berne.off gps.csv
if grep -Eq 'built with GDAL|cannot be loaded' "$logs/err"; then
    refused 3 'gps\.csv is in EPSG:4326, berne\.off in EPSG:2056: '
    run sample --points-crs EPSG:4326 absent.off absent.csv; refused 3 "option '--points-crs': "
    finish
fi
exits 0
says 'gps\.csv: remark: its longitudes and latitudes are taken as WGS 84 \(EPSG:4326\); --points-crs names another system'
says 'gps\.csv: remark: 1 points have no position in the coordinate system of the mesh; their status is bad'
prints_line '^id,lon,lat,z,status$'
prints_line '^a,7.438632421,46.951082725,(99\.9|100\.0)[0-9]*,inside$'
prints_line '^b,NA,46,,bad$'; prints_line '^c,0,46,,outside$'
prints_line '^d,7.438632421,1e300,,bad$'
cp "$logs/out" told.txt
run sample --status --points-crs EPSG:4326 berne.off gps.csv --threads 1; exits 0
prints "$(<told.txt)"
holds "no remark on what was told" test "$(grep -c longitudes "$logs/err")" == 0
run locate --only-answers --points-crs EPSG:4326 berne.off gps.csv; exits 0
prints_line '^7.438632421,46.951082725,inside,[01],0\.' # as they stand
run sample --status --outside nearest --points-crs EPSG:4326 berne.off gps.csv
prints_line '^c,0,46,0,outside$'
run locate --points-crs EPSG:2056 edited.ply none.csv -o told.csv; exits 0; says_nothing
holds "beside a table" grep -q 2056 told.prj
# The axes are longitude and latitude, easting and northing, whatever their definition says.
printf '%s\n' 'E,N' '7.438632421,46.951082725' >en.csv
for crs in EPSG:4326 urn:ogc:def:crs:EPSG::4326 OGC:CRS84 EPSG:4258; do
    run locate --points-crs $crs --crs EPSG:2056 berne.off en.csv; exits 0; says_nothing
    prints_line ',inside,'
done
printf '%s\n' 'E,N' 4125898.590,2651988.789 >laea.csv # this definition has the northing first
run sample --status --points-crs EPSG:3035 berne.off laea.csv; exits 0; prints_line ',inside$'

printf '%s\n' 'laenge;breite' '7,438632421;46,951082725' >german.csv
run sample --status berne.off german.csv; exits 0; says 'taken as WGS 84'
prints_line '^7,438632421;46,951082725;[0-9]+,[0-9]+;inside$'

# Two pairs of columns: the system of the points, or else of the mesh, calls for one.
printf '%s\n' x,y,lon,lat 2600000,1200000,7.438632421,46.951082725 >both.csv
cp square.off plain.off
run locate plain.off both.csv -q; refused 2 'Both x,y and lon,lat fit'
run locate berne.off both.csv --only-answers -q; exits 0; prints_line '^2600000,1200000,'
run locate berne.off both.csv --only-answers --points-crs EPSG:4326; exits 0; says_nothing
prints_line '^7.438632421,46.951082725,inside,'
run locate --crs EPSG:4326 berne.off both.csv --only-answers -q; exits 0
prints_line '^7.438632421,46.951082725,outside,'
says_nothing

# Files of GDAL bring their system, and outputs keep it; a file without one says nothing.
run sample -q --points-crs EPSG:4326 berne.off en.csv -o a.gpkg; exits 0
for ending in gpkg geojson shp fgb; do
    run sample --status berne.off a.gpkg -o b.$ending; exits 0; says_nothing
    run sample --status berne.off b.$ending; exits 0; says_nothing; prints_line 'inside.*,inside$'
done
run sample -q --status --points-crs EPSG:3035 berne.off laea.csv -o laea.geojson; exits 0
run sample --status berne.off laea.geojson; exits 0; says_nothing; prints_line 'inside.*,inside$'
run_on '1,1' sample berne.off - -q --crs '' ; refused 2 "'--crs' must be a text"
rm berne.prj
run_on '1,1' sample berne.off - -o unknown.gpkg; exits 0
run sample --crs EPSG:2056 berne.off unknown.gpkg; exits 0
says 'unknown\.gpkg: warning: its coordinate system is not known'
echo '{"type":"Point","coordinates":[2600010,1200000]}' >planar.geojson
run sample --status --crs EPSG:2056 berne.off planar.geojson; exits 0; prints_line ',inside$'
says 'planar\.geojson: warning: its coordinate system is not known'
run sample --crs EPSG:2056 --points-crs EPSG:4326 berne.off a.gpkg; says_nothing
run sample --crs EPSG:2056 --points-crs EPSG:4258 berne.off a.gpkg
says 'a\.gpkg: warning: its file says that it is in EPSG:4326 \(WGS 84\), but --points-crs says EPSG:4258 \(ETRS89\), which is used'
run sample berne.off a.gpkg; exits 0
says 'berne\.off: warning: its coordinate system is not known, and a\.gpkg is in EPSG:4326'
# A datum without a known shift; a sphere takes longitudes and latitudes.
run locate --crs 'LOCAL_CS["plan"]' --points-crs EPSG:4326 berne.off en.csv
refused 3 'en\.csv is in EPSG:4326 \(WGS 84\), berne\.off in plan: PROJ has no way'
printf '%s\n' OFF '4 4 0' '1 1 1' '-1 -1 1' '-1 1 -1' '1 -1 -1' '3 0 1 2' '3 0 3 1' '3 0 2 3' \
    '3 1 3 2' >tetra.off
echo '{"type":"Point","crs":{"type":"name","properties":{"name":"EPSG:2056"}},"coordinates":[2600000,1200000]}' >swiss.geojson
run star --lonlat --only-answers tetra.off swiss.geojson; exits 0; cp "$logs/out" swiss.txt
echo 7.438632421,46.951082725 >gps.txt
run star --lonlat --only-answers tetra.off gps.txt; exits 0
holds "the same facet" test "$(cut -d, -f3,4 "$logs/out")" == "$(cut -d, -f3,4 swiss.txt)"

# Polygons have a system, too.
echo '{"type":"Feature","properties":{"id":"P7"},"geometry":{"type":"Polygon","coordinates":[[[7,46],[8,46],[8,47],[7,47]]]}}' >canton.geojson
echo 'E,N' >swiss.csv
echo '2600000,1200000' >>swiss.csv
for attribute in '' '--attribute id'; do
    # shellcheck disable=SC2086
    run locate --points-crs EPSG:2056 --polygons canton.geojson $attribute swiss.csv; exits 0
    says_nothing
    prints_line '^2600000,1200000,inside,0,'
done
run locate --polygons canton.geojson --attribute id swiss.csv; exits 0
says 'swiss\.csv: warning: its coordinate system is not known, and canton\.geojson is in EPSG:4326'

# Points and constraints of a triangulation come into one system: that of --crs, or of the points,
# or of the constraints.
printf '%s\n' E,N,h 2600000,1200000,1 2600100,1200000,2 2600050,1200100,3 >survey.csv
echo '{"type":"LineString","coordinates":[[7.438960837,46.951172702],[7.439387,46.951352619]]}' \
    >brook.geojson
run triangulate survey.csv --constraints brook.geojson -q -o t.ply; exits 0 # unknown and known
run info t.ply; prints_line '^crs +not known$'; prints_line '^low +7\.4'
run triangulate survey.csv --constraints brook.geojson -o t.ply; exits 0
says 'survey\.csv: warning: its coordinate system is not known, and brook\.geojson is in EPSG:4326.*--points-crs names it'
run triangulate survey.csv --points-crs EPSG:2056 --constraints brook.geojson -o t.ply; exits 0
says_nothing
run info t.ply; prints_line '^crs +EPSG:2056'; prints_line '^low +2600000 1200000$'
run_on 'locate 2600051 1200040' edit t.ply - --constraints brook.geojson -q -o u.ply; exits 0
cp "$logs/out" u.txt
run triangulate survey.csv --crs EPSG:2056 --constraints brook.geojson -o v.ply; exits 0
says_nothing
holds "--crs tells the system of points that do not" same_text t.ply v.ply
run triangulate survey.csv --crs EPSG:4326 --points-crs EPSG:2056 --constraints brook.geojson -o \
    w.ply
exits 0; says_nothing
run info w.ply; prints_line '^crs +EPSG:4326'; prints_line '^high +7\.4399.* 46\.95198'
run triangulate gps.csv --points-crs EPSG:4326 --crs EPSG:2056 -o x.ply
refused 3 'gps\.csv: 1 of its points have no position in EPSG:2056.*ogr2ogr -clipsrc'
run triangulate --constraints brook.geojson --crs EPSG:2056 --keep hull -o x.ply; exits 3
printf '%s\n' lon,lat,z 7.438,46.951,1 7.439,46.951,2 7.4385,46.952,3 >lonlat.csv
run triangulate lonlat.csv -o x.ply; exits 0; says_nothing; run info x.ply
prints_line '^crs +not known$'
run triangulate lonlat.csv --crs EPSG:2056 -o x.ply; exits 0; says 'taken as WGS 84 \(EPSG:4326\)'
run info x.ply; prints_line '^low +2599.* 11999'
run triangulate lonlat.csv --crs x -o x.ply; refused 2 "'--crs' must be a coordinate system"
run triangulate lonlat.csv --constraints-crs EPSG:4326 -o x.ply
refused 2 "needs --constraints"
run triangulate --points-crs EPSG:4326 --constraints brook.geojson -o x.ply
refused 2 'need POINTS, which are missing'

# Without GDAL.
mkdir without
for library in /usr/lib/x86_64-linux-gnu/libgdal.so.*; do : >"without/$(basename "$library")"; done
export LD_LIBRARY_PATH=$PWD/without
run sample --crs EPSG:2056 berne.off gps.csv
refused 3 'gps\.csv is in EPSG:4326, berne\.off in EPSG:2056: GDAL, which would transform it, cannot be loaded'
run triangulate survey.csv --points-crs EPSG:2056 --constraints brook.geojson -o y.ply
refused 3 'brook\.geojson is in EPSG:4326, the mesh in EPSG:2056: GDAL'
absent y.ply
run sample --points-crs EPSG:4326 absent.off absent.csv
refused 3 "option '--points-crs': GDAL, which would transform the points"
run sample -q --crs EPSG:2056 --points-crs epsg:2056 berne.off en.csv -o same.csv; exits 0
absent same.prj
unset LD_LIBRARY_PATH
finish
