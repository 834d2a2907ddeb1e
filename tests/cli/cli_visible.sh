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
run visible ridge.off --from 0,1; refused 2 'look at what'
run visible ridge.off --from 0,1 --to sites.csv --raster -o x.tif; refused 2 'look at what'
run visible ridge.off --from 0,1 --to sites.csv --resolution 1; refused 2 'are for --raster'
run visible ridge.off --from 0,1,5 --height 2 --to sites.csv; refused 2 'without Z'
run visible ridge.off --from 3,1,2 --to sites.csv; refused 3 'height there is 4'
run visible ridge.off --from 20,1 --to sites.csv; refused 3 'above no ground'
run visible ridge.off --from 0,x --to sites.csv; refused 2 "'--from'"
run visible ridge.off --from 0,1 --to absent.csv; refused 3 'absent.csv'
finish
