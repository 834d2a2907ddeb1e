#!/usr/bin/env bash
# Points from vector files, by GDAL: attributes, layers, conditions, missing geometries; what is
# refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# LeakSanitizer stops all threads when the program ends, and sometimes crashes over those of GDAL,
# which end at that time.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
printf '%s\n' "$square" >square.off # on the plane z = x + y

# Outputs whose names say that they are no text are refused before anything is read.
for name in out.tab out.pdf out.DXF out.csv.gz out.xlsx ./a.b/out.tif; do
    run sample absent.off absent.csv -o $name
    refused 2 "${name//./\\.}: answers are written as text \(CSV\), or by GDAL as \.gpkg.*: [a-zA-Z]"
    run star absent.off absent.csv -o $name; refused 2 'as text'
    run probe absent.off absent.csv -o $name; refused 2 'as text'
done
run_on $'0.75,0.25\n' sample square.off - -o gpkg; exits 0
run_on '{"type":"Point","coordinates":[0.75,0.25]}' sample square.off -
refused 3 'standard input: this is JSON, not a table'
run_on $'x,y\n0,0\n' sample square.off - --layer a
refused 2 "'--layer' is for files that GDAL reads"
run_on $'x,y\n0,0\n' sample square.off - --where a
refused 2 "'--where' is for files that GDAL reads"

cat >one.geojson <<'END'
{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":"007","x":1.5,"n":3,"t":"a, \"b\"\nc"},"geometry":{"type":"Point","coordinates":[0.75,0.25]}},{"type":"Feature","properties":{"id":"B8","x":null,"n":9007199254740993},"geometry":null},{"type":"Feature","properties":{"id":" 9","x":0.1},"geometry":{"type":"MultiPoint","coordinates":[[0.5,0.5]]}}]}
END
run sample square.off one.geojson
if grep -Eq 'built with GDAL|cannot be loaded' "$logs/err"; then
    refused 3 'one\.geojson: '
    run sample absent.off absent.csv -o out.gpkg; refused 2 'out\.gpkg: '
    finish
fi
exits 0
says "square\.off: warning: its coordinate system is not known, and one\.geojson is in EPSG:4326 \(WGS 84\)"
# Points and others in one layer: there may be heights.
prints 'x_mw,y,z,id,x,n,t,z_mw
0.75,0.25,,007,1.5,3,"a, ""b""
c",1
,,,B8,,9007199254740993,,
0.5,0.5,," 9",0.1,,,1'
cp one.geojson many.geojson
sed -i 's/},{/},\n{/g' many.geojson
run sample square.off one.geojson -o one.csv; exits 0
run sample square.off many.geojson -o many.csv; exits 0
holds "one line or many, all is the same" same_text one.csv many.csv
cp one.geojson without-ending
run sample square.off without-ending; exits 0; prints "$(<one.csv)"
run sample --strict --status square.off one.geojson; exits 1; prints_line ',,bad$'
run locate --only-answers --where 'n = 3' square.off one.geojson; exits 0
prints $'x,y,status,triangle,w0,w1,w2\n0.75,0.25,inside,0,0.25,0.5,0.25'
run sample --where 'm = 3' square.off one.geojson
refused 2 "'--where' is not a valid condition on the layer: GDAL says: "
run sample --layer none square.off one.geojson; refused 3 "has no layer 'none'; it has: one"
run sample --columns x,y square.off one.geojson; refused 2 "'--columns' is for tables"

# Layers: only those count that have features.
cat >tracks.gpx <<'END'
<?xml version="1.0"?>
<gpx version="1.1" creator="t" xmlns="http://www.topografix.com/GPX/1/1">
<wpt lat="0.25" lon="0.75"><ele>12.5</ele><name>spring</name></wpt>
<wpt lat="2" lon="3"></wpt>
</gpx>
END
run sample square.off tracks.gpx; exits 0; prints_line '^x,y,ele,.*,name,.*,z$'
prints_line '^0.75,0.25,12.5,.*,spring,.*,1$'
prints_line '^3,2,,.*,$'
sed -i 's|</gpx>|<trk><trkseg><trkpt lat="0" lon="1"/><trkpt lat="1" lon="1"/></trkseg></trk></gpx>|' tracks.gpx
run sample square.off tracks.gpx
refused 2 'tracks\.gpx: which layer has the points\? --layer may be one of: waypoints, routes, tracks,'
run profile -q square.off tracks.gpx; exits 0; prints_line '^0,0,.*,0,1,0,[0-9.]+,[0-9]+,begin$'
run sample --only-answers --layer track_points square.off tracks.gpx; exits 0
prints $'x,y,z\n1,0,1\n1,1,2'

# Heights, for rays from a centre; lines and damage.
printf '{"type":"FeatureCollection","features":[%s%s]}' \
    '{"type":"Feature","properties":{"k":1},"geometry":{"type":"Point","coordinates":[0,0,2]}},' \
    '{"type":"Feature","properties":{"k":2},"geometry":{"type":"Point","coordinates":[1,1,3]}}' \
    >heights.geojson
run locate square.off heights.geojson; exits 0; prints_line '^x,y,z,k,status,'
prints_line '^1,1,3,2,vertex,0,0,0,1$'
printf '%s\n' OFF '4 4 0' '1 1 1' '-1 -1 1' '-1 1 -1' '1 -1 -1' '3 0 1 2' '3 0 3 1' '3 0 2 3' \
    '3 1 3 2' >tetra.off
run star tetra.off heights.geojson; exits 0; prints_line '^0,0,2,1,edge,'
echo '{"type":"Point","coordinates":[0,1]}' >flat.geojson
run star tetra.off flat.geojson
refused 3 'flat\.geojson: its points have x and y, but 3 numbers are wanted'
run probe tetra.off heights.geojson; refused 3 'but 6 numbers are wanted'
echo '{"type":"LineString","coordinates":[[0,0],[1,1]]}' >line.geojson
run sample square.off line.geojson -o out.csv; refused 3 'line\.geojson: GDAL finds no points in it'
echo '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[0,0]}},
{"type":"Feature","properties":{},"geometry":{"type":"LineString",
"coordinates":[[0,0],[1,1]]}}]}' >mixed.geojson
run sample square.off mixed.geojson -o out.csv
refused 3 'mixed\.geojson: feature 1 is a LINESTRING, not a point'
echo '{"type":' >damaged.geojson
run sample square.off damaged.geojson -o out.csv; refused 3 'damaged\.geojson: GDAL says: '
printf 'SQLite format 3\0 and nothing more' >damaged.gpkg
run sample square.off damaged.gpkg -o out.csv; refused 3 'damaged\.gpkg: GDAL says: '
run sample square.off absent.gpkg -o out.csv; refused 3 'absent\.gpkg: No such file'
absent out.csv

# Answers as vector files: every column with its kind, missing values, rows without a point, in
# order.
cat >wells.csv <<'END'
site,code,depth,n,remark,x,y,fid
B12,007,1.50,3,"dry, ""windy""",0.75,0.25,1
B13,012,NA,,,NA,NA,2
B14,100,-2e3,12,-,0.5,0.5,3
END
for ending in gpkg geojson geojsonl geojsons shp gml kml jml sqlite db fgb; do
    if [[ $ending == fgb ]]; then
        run sample square.off wells.csv -o out.fgb
        refused 3 'out\.fgb: row 2 has no point, which FlatGeobuf cannot hold'
        absent out.fgb
        run sample square.off wells.csv -o out.gpx
        refused 3 'out\.gpx: row 2 has no point, which GPX cannot hold'
        absent out.gpx
        sed -i /B13/d wells.csv
    fi
    run sample --status square.off wells.csv -o out.$ending; exits 0; says_nothing; prints ''
    holds "no temporary directory is left" test -z "$(find . -name '.meshwalk*')"
    run locate -q square.off out.$ending -o back.csv; exits 0
    holds "$ending: the columns are there" grep -Eq \
        '^x(_mw)?,y(_mw)?,(.*,)?site,code,depth,n,remark,' back.csv
    holds "$ending: numbers, texts and points" grep -Eq \
        '^0.75,0.25,(.*,)?B12,007,1.5,3,"dry, ""windy""",.*,1,inside,' back.csv
    [[ $ending == fgb ]] || holds "$ending: missing values, and no point" grep -Eq \
        '^,,(.*,)?B13,012,,,,.*,bad,.*bad,-1,,,$' back.csv
    holds "$ending: the order" grep -Eq '^0.5,0.5,(.*,)?B14,100,-2000,12,-,.*,1,edge,' \
        <(tail -n 1 back.csv)
done
run sample square.off wells.csv -o out.gpkg; exits 0 # over an older one
run sample -q square.off out.gpkg; prints_line '^0.75,0.25,B12,007,1.5,3,.*,1,1,1$'
printf 'id;x;y\nA;0,75;0,25\n' >comma.csv
run locate --only-answers square.off comma.csv -o comma.geojson; exits 0
run sample square.off comma.geojson; exits 0
prints $'x,y,status,triangle,w0,w1,w2,z\n0.75,0.25,inside,0,0.25,0.5,0.25,1'
run sample square.off comma.csv -o comma.fgb; exits 0
run sample square.off comma.fgb; exits 0
prints $'x_mw,y_mw,id,x,y,z,z_mw\n0.75,0.25,A,0.75,0.25,1,1'
: >none.csv
# Bytes that are not UTF-8 would be written as they are, and nobody could read them.
printf 'x,y,town\n0.5,0.25,Z\374rich\n' >latin1.csv
run sample square.off latin1.csv; exits 0
run sample square.off latin1.csv -o latin1.gpkg
refused 3 "latin1\.gpkg: row 1: the text in the column 'town' is not UTF-8"
printf 'x,y,H\366he\n0.5,0.25,1\n' >latin1.csv
run sample square.off latin1.csv -o latin1.geojson
refused 3 'latin1\.geojson: the name of column 3 is not UTF-8'
holds "nothing is left" test ! -e latin1.gpkg -a ! -e latin1.geojson
run sample square.off none.csv -o none.gpkg; exits 0
run sample square.off none.gpkg; exits 0; prints x_mw,y_mw,x,y,z,z_mw
run star --lonlat tetra.off none.csv -o none.gpkg; exits 0
run star tetra.off heights.geojson -o rays.gpkg; exits 0
run star tetra.off rays.gpkg; exits 0; prints_line '^x,y,z,k,status,triangle,w0,w1,w2,status_mw,'
prints_line '^0,0,2,1,edge,'
# A GPS takes waypoints, in degrees; databases take tables that they do not have yet.
run sample square.off wells.csv -o out.gpx; exits 0
run sample -q --layer waypoints square.off out.gpx; prints_line '^0.75,0.25,.*,B12,.*,1,1$'
run sample -q --points-crs EPSG:2056 square.off wells.csv -o lv95.gpx
refused 2 'lv95\.gpx: GPX can hold longitudes and latitudes only, but the points are in EPSG:2056 '
run sample -q --points-crs EPSG:2056 square.off wells.csv -o lv95.kml; exits 0
run sample -q square.off lv95.kml; prints_line '^-19\.9179[0-9]*,32\.1244[0-9]*,'
run sample square.off wells.csv -o out.sql; exits 0
holds "PostgreSQL: the rows" grep -q "INSERT INTO.*'B12', '007', 1.5, 3," out.sql
holds "PostgreSQL: no table is dropped" test "$(grep -ci drop out.sql)" == 0
# All digits, and numbers that Shapefiles have no room for.
run_on $'x,y\n0.12345678901234568,0.25\n' sample square.off - -o digits.geojsonl; exits 0
run sample -q square.off digits.geojsonl; prints_line '^0.12345678901234568,0.25,'
run_on $'x,y,v\n0.5,0.25,1e-20\n' sample square.off - -o small.shp; exits 0
says "row 1: the column 'v' has 1e-20, which a Shapefile rounds to 15 decimals"
run_on $'x,y,v\n0.5,0.25,1e30\n' sample square.off - -o large.shp; exits 3
says "row 1: the column 'v' has 1e\+30, which is too large for a Shapefile"; absent large.shp
run_on $'x,y,v\n0.5,0.25,1234567890.12\n' sample square.off - -o plain.shp; exits 0; says_nothing
# The coordinate system goes along.
run sample -q square.off tracks.gpx --layer waypoints -o crs.gpkg; exits 0
holds "the coordinate system is kept" grep -q 'WGS 84' crs.gpkg
# A column of numbers with a text far behind; a name that the format has no room for.
# a sanitizer takes more, and long
if (ulimit -v 4000000; "$meshwalk" --version) >/dev/null 2>&1; then
    { echo id,x,y; yes 1,0,0 | head -n 262144; echo B7,0,0; } >late.csv
    run sample square.off late.csv -o late.fgb
    exits 3; says "row 262145: the column 'id' had numbers only, but here 'B7'"; absent late.fgb
fi
run_on $'measured_depth,x,y\n1,0,0\n' sample square.off - -o long.shp; exits 0
says "long\.shp: remark: the column 'measured_depth' is called 'measured_d' in this format"
run_on $'500000,4000000\n' sample square.off - -o utm.geojson; exits 0
says 'utm\.geojson: warning: GeoJSON holds longitudes and latitudes, but row 1 has other numbers'
run sample square.off wells.csv -o absent/out.gpkg; refused 4 'absent/out\.gpkg: No such file'
holds "no temporary directory is left" test -z "$(find . -name '.meshwalk*')"

# Formats that this GDAL may lack: tried if it has them, refused by name if not.
run --version
if grep -q 'GDAL.*not .*\.parquet' "$logs/out"; then
    run sample absent.off absent.csv -o out.parquet
    refused 2 'out\.parquet: this GDAL does not write Parquet'
    printf 'PAR1 and nothing more' >in.parquet
    run sample square.off in.parquet; refused 3 'in\.parquet: this GDAL has no driver for Parquet'
else
    run sample -q square.off wells.csv -o out.parquet; exits 0
    run sample -q square.off out.parquet; exits 0; prints_line '^0.75,0.25,B12,'
fi

data=$source_tree/../shared/data/gis
if [[ -d $data ]]; then
    gunzip -c "$data/track.gpx.gz" >real.gpx
    run sample -q --layer track_points square.off real.gpx -o real.csv; exits 0
    holds "every track point has its row" test "$(wc -l <real.csv)" == 872
    gunzip -c "$data/b_pump.gpkg.gz" >pump.gpkg
    run sample -q square.off pump.gpkg; exits 0; prints_line '^x,y,cat,z$'
else
    left_out "there is no ../shared/data"
fi

# What the columns of a table become: numbers as programs write them are numbers, others texts; a
# column has the widest kind of its cells, and a number that is missing is none.
cat >kinds.py <<'END'
import json, subprocess, sys
cells = {"12": 12, "0": 0, "-7": -7, "007": "007", "+5": "+5", "1.": 1.0, ".5": ".5", "1.5": 1.5, "1e3": 1000.0,
         "1e": "1e", "1e+": "1e+", "1E-2": 0.01, "1e+05": 1e5, "1e5x": "1e5x", "12a": "12a", "--": "--", "1-2": "1-2",
         "123456789012345678": 123456789012345678, "1234567890123456789": "1234567890123456789",
         "123456789012345.5": 123456789012345.5, "1234567890123456.5": "1234567890123456.5", "0.5": 0.5,
         "00": "00", "-0": 0, "1.5.2": "1.5.2", " 4 ": 4, '" 4 "': " 4 ", '"say ""hi"""': 'say "hi"', '"7"': 7,
         '""': None, "": None, "a b": "a b", '"a,b"': "a,b", "2024-01-02": "2024-01-02"}
columns = [(["1", "2"], [1, 2]), (["1", "NA"], [1, None]), (["nan", "2"], [None, 2]), (["n/a", "-", "3"], [None, None, 3]),
           (["1", "2.5"], [1.0, 2.5]), (["2.5", "null"], [2.5, None]), (["1", "x"], ["1", "x"]),
           (["", "x"], [None, "x"]), (["1.5", "x", "2"], ["1.5", "x", "2"])]
rows = 3
header, table = ["x", "y"], [["0.5", "0.25"] for _ in range(rows)]
wanted = []
for cell, value in cells.items():
    wanted.append([value] * rows)
    for row in table: row.append(cell)
for given, values in columns:
    wanted.append(values + [values[-1]] * (rows - len(values)))
    for row, cell in zip(table, given + [given[-1]] * (rows - len(given))): row.append(cell)
header += [f"c{i}" for i in range(len(wanted))]
for separator in ",", ";":
    if separator == ";": table = [[c.replace(";", "") for c in row] for row in table]
    with open("kinds.csv", "w") as file:
        for row in [header, *table]: print(separator.join(row), file=file)
    subprocess.run([sys.argv[1], "locate", "-q", "square.off", "kinds.csv", "-o", "kinds.geojson"], check=True)
    features = json.load(open("kinds.geojson"))["features"]
    for i, values in enumerate(wanted):
        told = [f["properties"][f"c{i}"] for f in features]
        assert told == values and [type(t) for t in told] == [type(v) for v in values], (separator, header[i + 2], told, values)
END
rm -f kinds.geojson
holds 'columns have their kinds' python3 kinds.py "$meshwalk"
finish
