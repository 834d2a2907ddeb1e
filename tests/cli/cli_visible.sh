#!/usr/bin/env bash
# visible: what a ridge hides, touching lines, every column kept, rasters as points, what is
# refused. test_sight holds the lines themselves against an oracle.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

# A plain with a ridge at x = 3, 4 high.
printf '%s\n' OFF '10 8 0' '0 0 0' '0 2 0' '2 0 0' '2 2 0' '3 0 4' '3 2 4' '4 0 0' '4 2 0' '8 0 0' \
    '8 2 0' '3 0 2 1' '3 2 3 1' '3 2 4 3' '3 4 5 3' '3 4 6 5' '3 6 7 5' '3 6 8 7' '3 8 9 7' \
    >ridge.off
printf '%s\n' 'name,x,y,colour' 'near,1.5,1,red' 'slope,2.5,1,red' 'top,3,1,blue' \
    '"behind, low",5,1,green' 'far,8,1,green' 'away,9,1,grey' >sites.csv

run visible ridge.off --from 0,1 --to sites.csv; exits 0; says_nothing
prints 'name,x,y,colour,visible,obstacle_x,obstacle_y
near,1.5,1,red,1,,
slope,2.5,1,red,1,,
top,3,1,blue,1,,
"behind, low",5,1,green,0,2.5,1
far,8,1,green,0,2.5,1
away,9,1,grey,,,'
# From 6.4 the line to (8, 1) touches the ridge; a hair lower it is hidden.
run visible ridge.off --from 0,1,6.4 --to sites.csv --only-answers; exits 0
prints_line '^8,1,1,,$'
prints_line '^5,1,0,3,1$'
run visible ridge.off --from 0,1,6.3999999 --to sites.csv --only-answers; exits 0
prints_line '^8,1,0,3,1$'
# At 8 to 5: the line passes (3, 3.2), below the ridge; 2 above the ground there it passes above.
run visible ridge.off --from 0,1 --height 8 --target-height 2 --to sites.csv --only-answers
exits 0
prints_line '^5,1,1,,$'
run visible ridge.off --from 0,1 --height 8 --target-height 1.2 --to sites.csv --only-answers
exits 0
prints_line '^5,1,0,3,1$'
run visible ridge.off --from 20,1,5 --to sites.csv --only-answers; exits 0
prints_line '^8,1,1,,$'
run visible -q --strict ridge.off --from 0,1 --to sites.csv; exits 1
run visible --threads 1 ridge.off --from 0,1 --to sites.csv; exits 0
cp "$logs/out" one.csv
run visible --threads 3 ridge.off --from 0,1 --to sites.csv; exits 0
holds 'no answer depends on threads' same_text one.csv "$logs/out"

# Several viewpoints: how many of them see each point.
run visible ridge.off --from '0,1;8,1' --to sites.csv; exits 0; says_nothing
prints 'name,x,y,colour,visible
near,1.5,1,red,1
slope,2.5,1,red,1
top,3,1,blue,2
"behind, low",5,1,green,1
far,8,1,green,1
away,9,1,grey,'
run visible ridge.off --from '0,1,6.4;8,1;5,1' --to sites.csv --only-answers; exits 0
prints_line '^8,1,3$'
prints_line '^2.5,1,1$'
for wrong in '0,1;' ';0,1' '0,1,2,' '0,1,2,3' '0' '0,1 8,1' 'nan,1'; do
    run visible ridge.off --from "$wrong" --to sites.csv; refused 2 "'--from'"
done
run visible ridge.off --from '0,1;20,1' --to sites.csv; refused 3 'at 20,1: the viewpoint is above no ground'

# Pairs: from the first to the last point of each line.
cat >pairs.geojson <<'END'
{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"link": "a, b"},
 "geometry": {"type": "LineString", "coordinates": [[0, 1], [2, 1]]}},
{"type": "Feature", "properties": {"link": "c"},
 "geometry": {"type": "MultiLineString", "coordinates": [[[0, 1], [4, 2], [8, 1]], [[8, 1], [4.5, 1]]]}},
{"type": "Feature", "properties": {"link": "d"},
 "geometry": {"type": "LineString", "coordinates": [[0, 1], [9, 1]]}},
{"type": "Feature", "properties": {"link": "e"},
 "geometry": {"type": "LineString", "coordinates": [[20, 1], [0, 1]]}}]}
END
if "$meshwalk" --version | grep -q 'GDAL .*found'; then
    run visible ridge.off --between pairs.geojson --points-crs same; exits 0
    says '2 of its lines have an end outside of ridge.off'
    prints 'feature,part,link,visible,obstacle_x,obstacle_y
0,0,"a, b",1,,
1,0,c,0,2.5,1
1,1,c,1,,
2,0,d,,,
3,0,e,,,'
    run visible -q ridge.off --between pairs.geojson --points-crs same --height 8 \
        --target-height 8; exits 0
    prints_line '^1,0,c,1,,$'
    run visible -q --strict ridge.off --between pairs.geojson --points-crs same; exits 1
    run visible -q ridge.off --between pairs.geojson --points-crs same -o links.gpkg; exits 0
    run profile -q ridge.off links.gpkg --attribute link,visible,obstacle_x; exits 0
    prints_line '^1,0,c,0,2.5,0,0,1,0,0,begin$'
else
    left_out 'GDAL is not found: no attributes of pairs'
fi
run visible ridge.off --between pairs.geojson --from 0,1; refused 2 'cannot be used with --between'
run visible ridge.off --between pairs.geojson --to sites.csv; refused 2 'what is looked at'

# Another field; heights that are missing hide nothing.
sed 's/^3 \([02]\) 4$/3 \1 -99999/' ridge.off >hole.off
run visible -q hole.off --from 0,1 --to sites.csv --only-answers; exits 0
prints_line '^5,1,1,,$'
prints_line '^3,1,,,$'

# Every pixel of a raster is what its centre is as a point.
if "$meshwalk" --version | grep -q 'GDAL .*found'; then
    perl -e 'srand 7; print "x,y,z\n"; printf "%.9f,%.9f,%.6f\n", rand 100, rand 100, rand 20
        for 1 .. 300' >random.csv
    run triangulate -q random.csv -o random.ply; exits 0
    perl -e 'print "x,y\n"; for my $j (0 .. 39) { for my $i (0 .. 41) {
        printf "%.17g,%.17g\n", -2 + ($i + 0.5) * 2.5, 102 - ($j + 0.5) * 2.5 } }' >centres.csv
    for height in 0 3; do
        run visible -q random.ply --from 48.3,51.7 --height $height --to centres.csv \
            --only-answers; exits 0
        awk -F, 'NR > 1 { print $3 == "" ? 255 : $3 }' "$logs/out" >asked
        run visible random.ply --from 48.3,51.7 --height $height --raster --resolution 2.5 \
            --extent -2,2,103,102 -o seen.img --driver ENVI; exits 0; says_nothing
        prints_line '^columns +42$'
        prints_line "^visible +$(grep -c '^1$' asked)\$"
        prints_line "^empty +$(grep -c '^255$' asked)\$"
        holds 'pixels are what points are' \
            same_text <(od -An -v -tu1 -w1 seen.img | tr -d ' ') asked
    done
    # Of several viewpoints their number; more than 254 do not fit into bytes.
    many='48.3,51.7;20,20;77,15'
    for number in 3 255; do
        run visible -q random.ply --from "$many" --to centres.csv --only-answers; exits 0
        awk -F, -v none=$((number == 3 ? 255 : -1)) \
            'NR > 1 { print $3 == "" ? none : $3 }' "$logs/out" >asked
        run visible random.ply --from "$many" --raster --resolution 2.5 \
            --extent -2,2,103,102 -o seen.img --driver ENVI; exits 0; says_nothing
        prints_line "^viewpoints +$number\$"
        prints_line "^hidden +$(grep -c '^0$' asked)\$"
        type=$([[ $number == 3 ]] && echo u1 || echo d4)
        holds 'pixels are counts' same_text \
            <(od -An -v -t"$type" -w"${type:1}" seen.img | tr -d ' ') asked
        many+=$(for ((i = 3; i < 255; i++)); do printf ';%d,%d' $((i * 7 % 80 + 10)) \
            $((i * 3 % 80 + 10)); done)
    done
    run visible -q random.ply --from 48.3,51.7 --raster -o seen.tif; exits 0; says_nothing
    run visible random.ply --from 48.3,51.7 --raster --like seen.tif -o like.tif --json; exits 0
    holds 'the report is JSON' is_json "$logs/out"
    run visible -q random.ply --from 48.3,51.7 --to centres.csv -o seen.gpkg; exits 0
    run visible random.ply --from 1,2 --raster --like seen.tif --resolution 3 -o x.tif
    refused 2 'cannot be used with --like'
    run visible random.ply --from 48,51 --raster -o x.txt; refused 2 'no raster format has'
else
    left_out 'GDAL is not found: no rasters'
fi

run visible ridge.off --to sites.csv; refused 2 'where is the viewpoint'
run visible ridge.off --from 0,1; refused 2 'what is looked at'
run visible ridge.off --from 0,1 --to sites.csv --raster -o x.tif; refused 2 'what is looked at'
run visible ridge.off --from 0,1 --to sites.csv --resolution 1; refused 2 'need --raster'
run visible ridge.off --from 0,1,5 --height 2 --to sites.csv; refused 2 'without Z'
run visible ridge.off --from 3,1,2 --to sites.csv; refused 3 'height there is 4'
run visible ridge.off --from 20,1 --to sites.csv; refused 3 'above no ground'
run visible ridge.off --from 0,x --to sites.csv; refused 2 "'--from'"
run visible ridge.off --from 0,1 --to absent.csv; refused 3 'absent.csv'
finish
