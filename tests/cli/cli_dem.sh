#!/usr/bin/env bash
# A TIN from a raster, by GDAL: the tolerance holds at every pixel, pixels without a height are left
# out, breaklines are kept; what is refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# LeakSanitizer stops all threads when the program ends, and sometimes crashes over those of GDAL,
# which end at that time.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

# grid FILE NODATA-CONDITION: a raster of 60 x 40 pixels; text that GDAL reads.
grid() {
    perl -e 'my $c = $ARGV[0];
        print "ncols 60\nnrows 40\nxllcorner 1000\nyllcorner 2000\n";
        print "cellsize 2.5\nNODATA_value -9999\n";
        for $j (0 .. 39) { for $i (0 .. 59) {
            printf "%s ", eval($c) ? -9999 :
                sprintf "%.3f", 20 * sin($i / 7) + 10 * cos($j / 5) + $i * $j / 90
        } print "\n" }' -- "$2" >"$1"
}
grid full.asc 0
# A raster is no mesh, and no table of points.
run info full.asc; refused 3 "'meshwalk triangulate --from full\.asc --tolerance Z -o MESH'"
printf 'II*\0\1' >dem.TIF
run triangulate dem.TIF -o out.ply; refused 3 "'meshwalk triangulate --from dem\.TIF --tolerance"
run info absent.tif; exits 3; holds 'no hint' test -z "$(grep triangulate "$logs/err")"
run triangulate --from full.asc --tolerance 1 -o out.ply
if grep -Eq 'built with GDAL|cannot be loaded' "$logs/err"; then
    refused 3 'full\.asc: '
    finish
fi
exits 0; prints_line '^pixels +2400$'; prints_line '^left out +0$'; prints_line '^heights +raster$'

# pixels FILE: column, row and height of each pixel that has one.
pixels() {
    perl -ane 'next if $. < 7; for (0 .. $#F) {
        next if $F[$_] == -9999;
        my ($x, $y) = (1000 + ($_ + .5) * 2.5, 2100 - ($. - 7 + .5) * 2.5);
        printf "%.17g,%.17g,%s\n", $x, $y, $F[$_] }' "$1"
}
# keeps_to DEM TOLERANCE PIXELS: that many pixels of the raster lie in out.ply, none missed by more.
keeps_to() {
    { echo x,y,h; pixels "$1"; } >points.csv
    run sample -q out.ply points.csv
    exits 0
    holds "$1 within $2" perl -F, -ane 'BEGIN { ($t, $n) = splice @ARGV, 0, 2 } next if $. == 1;
        chomp $F[3]; $n--, $bad += abs($F[2] - $F[3]) > $t + 2e-5 if $F[3] ne "";
        END { exit($bad || $n ? 1 : 0) }' "$2" "$3" "$logs/out"
}
keeps_to full.asc 1 2400
run triangulate -q --from full.asc --tolerance 5 -o out.ply; exits 0; says_nothing
keeps_to full.asc 5 2400
coarse=$(wc -c <out.ply)
run triangulate -q --from full.asc --tolerance 0 -o out.ply; exits 0
keeps_to full.asc 0 2400
holds "less tolerance, more triangles" test "$(wc -c <out.ply)" -gt "$coarse"
run triangulate -q --from full.asc --tolerance 5 -o one.ply --threads 1; exits 0
run triangulate -q --from full.asc --tolerance 5 -o many.ply --threads 5; exits 0
holds "threads change nothing" cmp -s one.ply many.ply

# Pixels without a height: inside, along a side, one alone; a pixel alone makes no triangle.
grid holes.asc '($i-20)**2+($j-15)**2 < 60 || $j < 3 + $i % 5 || $i == 50 && $j == 30 || $i > 56 && !($i == 58 && $j == 20)'
run triangulate --from holes.asc --tolerance 2 -o out.ply; exits 0
says 'holes\.asc: warning: [0-9]+ of its pixels have a height, but lie in no triangle'
left=$(awk '$1 == "left" { print $3 }' "$logs/out")
keeps_to holes.asc 2 $(($(pixels holes.asc | wc -l) - left))
holds "few are left out" test "$left" -lt 20
run raster -q out.ply -o back.img --driver ENVI --like holes.asc; exits 0
holds "no pixel without a height lies in a triangle" perl -e '
    local $/; open my $h, "<:raw", "back.img" or die; my @v = unpack "f*", <$h>;
    open my $g, "<", "holes.asc"; my @w = split " ", (split /-9999\n/, <$g>, 2)[1];
    die scalar @w unless @w == 2400;
    for (0 .. $#v) { exit 1 if $w[$_] == -9999 && $v[$_] != -9999 }'

# Breaklines and a boundary.
cat >lines.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[1010,2010],[1071.3,2055.7],[1140,2020]]}},
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[1020,2080,31],[1120,2082,33]]}}]}
END
run triangulate --from full.asc --tolerance 2 --constraints lines.geojson -o out.ply
exits 0
prints_line '^constraints +3$'
keeps_to full.asc 2 2400
run_on $'1020,2080\n1070,2081\n1120,2082\n' sample -q out.ply -; exits 0
holds "the breakline keeps its heights" test "$(cut -d, -f3 "$logs/out" | xargs)" == "z 31 32 33"
sed -i 's/1140,2020/1300,2020/' lines.geojson
run triangulate --from full.asc --tolerance 2 --constraints lines.geojson -o bad.ply
refused 3 'lines\.geojson: the point 1300, 2020 has no height, and full\.asc has none there'
echo '{"type":"Polygon","coordinates":[[[1020,2020],[1100,2030],[1060,2090],[1020,2020]]]}' \
    >part.geojson
run triangulate --from full.asc --tolerance 2 --boundary part.geojson -o out.ply; exits 0
says_nothing
keeps_to full.asc 2 "$(awk '$1 == "pixels" { print $2 }' "$logs/out")"

# Coordinate systems, bands, and what is refused.
run triangulate -q --from full.asc --tolerance 5 -o out.ply --crs EPSG:32632; exits 0
holds "the system is kept" grep -aq '^comment crs EPSG:32632' out.ply
run raster -q out.ply -o utm.tif --resolution 2.5; exits 0
run triangulate -q --from utm.tif --tolerance 1 -o back.ply; exits 0
holds "the raster's system" grep -aq '^comment crs PROJCS.*UTM zone 32N' back.ply
run triangulate --from utm.tif --tolerance 1 -o bad.ply --crs EPSG:2056
refused 3 'utm\.tif: is in another coordinate system than --crs says'
run triangulate --from utm.tif --tolerance 1 -o bad.ply --band 2
refused 3 'utm\.tif: has 1 bands; there is no band 2'
run triangulate --from absent.tif --tolerance 1 -o bad.ply; refused 3 'absent\.tif: GDAL says: '
run triangulate --from full.asc -o bad.ply; refused 2 '--from needs --tolerance Z'
run triangulate points.csv --tolerance 1 -o bad.ply
refused 2 '--tolerance and --band need --from'
run triangulate points.csv --from full.asc --tolerance 1 -o bad.ply
refused 2 'give POINTS or --from RASTER, not both'
run triangulate --from full.asc --tolerance 1 --kind min-weight -o bad.ply
refused 2 '--from is for --kind delaunay only'
run triangulate --from full.asc --tolerance 1 --max-edge 3 -o bad.ply
refused 2 '--from and --max-edge cannot be used together'
grid empty.asc 1
run triangulate --from empty.asc --tolerance 1 -o bad.ply; exits 3
grid line.asc '$j != 7'
run triangulate --from line.asc --tolerance 1 -o bad.ply; exits 3
absent bad.ply
finish
