#!/usr/bin/env bash
# Rasters of meshes, by GDAL: every pixel as locate and sample answer at its centre, grids, bands,
# formats, what is refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# LeakSanitizer stops all threads when the program ends, and sometimes crashes over those of GDAL,
# which end at that time.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
printf '%s\n' "$square" >square.off # on the plane z = x + y
printf '%s\n' "$ring" >ring.off

run raster square.off -o out.tif --resolution 0.25
if grep -Eq 'built with GDAL|cannot be loaded' "$logs/err"; then
    refused 2 'out\.tif: '
    finish
fi
exits 0
says_nothing
prints_line '^columns +4$'
prints_line '^extent +0 0 1 1$'
prints_line '^with value +16$'
only_files square.off ring.off out.tif

# centres WEST NORTH SIZE COLUMNS ROWS: the centres of pixels, as the program computes them.
centres() {
    perl -e 'my ($w, $n, $s, $c, $r) = @ARGV; print "x,y\n";
        for my $j (0 .. $r - 1) { for my $i (0 .. $c - 1) {
            printf "%.17g,%.17g\n", $w + ($i + 0.5) * $s, $n - ($j + 0.5) * $s } }' -- "$@"
}
# raw TYPE FILE: the pixels of a raw raster, one a line; "empty" for NaN and -1.
raw() {
    perl -e 'my ($t, $f) = @ARGV; local $/; open my $h, "<:raw", $f or die; for (unpack "$t*", <$h>) {
        print $_ != $_ || ($t eq "l" && $_ == -1) ? "empty" : sprintf("%.17g", $_), "\n" }' "$@"
}
# as_floats: numbers, one a line, rounded to floats; "empty" stays.
as_floats() {
    perl -ne 'chomp; print $_ eq "empty" ? $_ : sprintf("%.17g", unpack "f", pack "f", $_), "\n"'
}
# as_asked MESH WEST NORTH SIZE COLUMNS ROWS: heights and triangles are those that sample and locate
# find at the centres.
as_asked() {
    local mesh=$1 west=$2 north=$3 size=$4 columns=$5 rows=$6 box
    box=$(perl -e 'my ($w, $n, $s, $c, $r) = @ARGV; printf "%.17g,%.17g,%.17g,%.17g", $w, $n - $r * $s, $w + $c * $s, $n' -- "${@:2}")
    centres "$west" "$north" "$size" "$columns" "$rows" >points.csv
    "$meshwalk" sample -q --only-answers "$mesh" points.csv | perl -F, -ane 'next if $. == 1; chomp $F[2]; print $F[2] eq "" ? "empty" : sprintf("%.17g", $F[2]), "\n"' >asked.txt
    "$meshwalk" locate -q --only-answers "$mesh" points.csv | perl -F, -ane 'next if $. == 1; print $F[3] < 0 ? "empty" : $F[3], "\n"' >asked-triangles.txt
    run raster -q "$mesh" -o pixels.img --driver ENVI --type float64 \
        --resolution "$size" --extent "$box"
    exits 0
    holds "the heights of $mesh at $size" same_text <(raw d pixels.img) asked.txt
    run raster -q "$mesh" -o pixels.img --driver ENVI --resolution "$size" --extent "$box"
    exits 0
    holds "the heights of $mesh at $size, rounded to floats" \
        same_text <(raw f pixels.img) <(as_floats <asked.txt)
    run raster -q "$mesh" -o pixels.img --driver ENVI --derive triangle \
        --resolution "$size" --extent "$box"
    exits 0
    holds "the triangles of $mesh at $size" same_text <(raw l pixels.img) asked-triangles.txt
}
perl -e 'srand 7; print "x,y,z\n"; printf "%.9f,%.9f,%.6f\n", rand 100, rand 100, rand 50 for 1 .. 500' >random.csv
perl -e 'print "x,y,z\n"; for my $x (0 .. 20) { print "$x,$_,", ($x * 7 + $_ * $_) % 11, "\n" for 0 .. 20 }' >grid.csv
perl -e 'srand 8; print "x,y,z\n0,1,0\n1000,1,5\n"; printf "%.9f,%.9f,%.6f\n", rand 1000, rand 0.001, rand 50 for 1 .. 60' >thin.csv
perl -e 'srand 9; print "x,y,z\n"; printf "%.3f,%.3f,%.2f\n", 500000 + rand 1000, 4200000 + rand 1000, rand 50 for 1 .. 300' >utm.csv
perl -e 'srand 9; print "x,y,z\n"; printf "%g,%g,%.2f\n", 1e200 * rand, -1e200 * rand, rand 50 for 1 .. 30' >large.csv
for name in random grid thin utm large; do
    run triangulate -q $name.csv -o $name.ply; exits 0
done
as_asked random.ply -2 102 0.9 120 117
as_asked random.ply 40 60 0.013 100 40
as_asked random.ply 30 45 0.15 150 150 # some triangles are small to the scan, some are not
as_asked random.ply 70 71 0.3 110 70   # beyond the mesh in the east
as_asked grid.ply -0.5 20.5 1 21 21 # every centre is a vertex
as_asked grid.ply -0.25 20.25 0.5 41 41
as_asked thin.ply -1 1.001 0.02 90 60
as_asked utm.ply 500000.3 4200990 7.1 140 140
as_asked large.ply 0 0 5e198 20 20
as_asked ring.off -0.25 3.25 0.125 28 28
# Values that are missing, zeros of both signs, and values beyond and below those of floats.
perl -e 'srand 10; print "OFF\n144 242 0\n";
    my @z = (0, "-0", 5, "1e-42", "-1e-44", "1e39", "-2e300", 0.1, "nan", 3);
    for my $i (0 .. 143) {
        print 10 * ($i % 12) + rand, " ", 10 * int($i / 12) + rand, " ", $z[rand 10], "\n" }
    for my $y (0 .. 10) { for my $x (0 .. 10) { my $v = 12 * $y + $x;
        print "3 $v ", $v + 1, " ", $v + 13, "\n3 $v ", $v + 13, " ", $v + 12, "\n" } }' >values.off
as_asked values.off 0 110 0.9 122 122
printf '%s\n' OFF '4 2 0' '0 0 0' '4 0 1' '4 4 7' '0 4 2' '3 0 2 1' '3 0 2 3' >clockwise.off
as_asked clockwise.off -0.5 4.5 0.25 20 20

# Nothing depends on the number of threads, nor on how wide the rows are.
run raster -q random.ply -o one.img --driver ENVI --resolution 0.05 --threads 1; exits 0
run raster -q random.ply -o many.img --driver ENVI --resolution 0.05 --threads 7; exits 0
holds "one thread or seven" cmp -s one.img many.img

# Neither on triangles beyond the rows, nor on those that reach into many strips of rows.
run raster -q random.ply -o all.img --driver ENVI --resolution 0.125 --extent 0,0,100,100; exits 0
run raster -q random.ply -o part.img --driver ENVI --resolution 0.125 \
    --extent 20,30,60,50 --threads 3
exits 0
holds "a part of the raster" cmp -s part.img <(
    perl -e 'local $/; open my $h, "<:raw", "all.img" or die; my $p = <$h>;
        print substr $p, 4 * (800 * $_ + 160), 1280 for 400 .. 559')
run raster -q square.off -o tall.img --driver ENVI --resolution 0.001 --threads 3; exits 0
holds "triangles that are in all strips" test "$(raw f tall.img | sort -u | grep -c empty)" == 0

# The grid.
run raster random.ply -o out.tif
exits 0
prints_line '^resolution +2$'
prints_line '^extent +0 0 100 100$'
run raster square.off -o out.tif --json; exits 0; holds "the report is JSON" is_json "$logs/out"
run raster square.off -o out.tif --extent 0,0,1 ; refused 2 "'--extent' must be XMIN,YMIN,XMAX,YMAX"
run raster square.off -o out.tif --extent 0,0,0,1; refused 2 "'--extent' must be"
# A raster that nothing can hold.
echo '<VRTDataset rasterXSize="2000000000" rasterYSize="2000000000"><GeoTransform>0,1e-9,0,4,0,-1e-9
</GeoTransform><VRTRasterBand dataType="Float32" band="1"/></VRTDataset>' >endless.vrt
run raster square.off -o out.tif --like endless.vrt
refused 4 'a raster of 2000000000 times 2000000000 pixels is too large'
run triangulate --from endless.vrt --tolerance 1 -o out.ply
refused 4 'a raster of 2000000000 times 2000000000 pixels is too large'
run raster square.off -o out.tif --resolution 1e-12
refused 4 'a raster with pixels of 1e-12 would have too many'
run raster square.off -o out.tif --resolution 1e-7; refused 4 'a raster with pixels of 1e-07? would have too many'
run raster utm.ply -o out.tif --resolution 1e-11 \
    --extent 500000,4200000,500000.00000001,4200000.00000001
refused 4 'too small for its coordinates'
run raster random.ply -o like.tif --resolution 3.7 --extent 10,20,55,71 --nodata -9999; exits 0
run raster square.off -o out.tif --like like.tif
exits 0
prints_line '^columns +13$'
prints_line '^extent +10 19.199999999999996 58.1 71$'
prints_line '^nodata +-9999$'; says 'warning: no pixel has a value: none of their centres lies in a triangle whose vertices have'
run raster square.off -o out.tif --like like.tif --resolution 1
refused 2 'with --like, which sets the pixels'
run raster square.off -o like.tif --like like.tif; refused 2 'like\.tif'
run raster square.off -o out.tif --like square.off; refused 3 'square\.off: GDAL says: '
run raster square.off -o a.tif --resolution 0.25 --crs EPSG:2056; exits 0
run raster square.off -o b.tif --like a.tif --crs EPSG:21781
refused 3 'square\.off is in EPSG:21781 .*, a\.tif in EPSG:2056 .*: transform one of them first; .*gdalwarp -t_srs'
run raster square.off -o b.tif --like a.tif
exits 0
says 'square\.off: warning: its coordinate system is not known, and a\.tif is in EPSG:2056'
run raster square.off -o b.tif --like a.tif --crs EPSG:2056; exits 0; says_nothing

# Bands.
run raster -q square.off -o out.img --driver ENVI --resolution 0.5 \
    --derive slope,aspect,hillshade,triangle
exits 0
holds "slope, aspect, hillshade, triangle" test "$(raw d out.img | cut -c 1-9 | uniq | xargs)" == "54.735610 225 104.69506 1 0"
run raster -q square.off -o out.img --driver ENVI --resolution 0.5 --derive hillshade; exits 0
holds "hillshade as bytes" test "$(raw C out.img | xargs)" == "105 105 105 105"
run raster square.off -o out.tif --derive slope,slope
refused 2 "'--derive' must be some of slope,aspect,hillshade,triangle"
run raster square.off -o out.tif --derive heights; refused 2 "'--derive' must be some of"
run raster square.off -o out.tif --derive slope --crs EPSG:4326 --resolution 0.25
exits 0
says 'warning: it is in longitudes and latitudes, so its slopes are heights over degrees'
run raster square.off -o out.tif --field depth
refused 3 "square\.off: has no field 'depth'; --field may be one of: z"

# Values that are missing, outside, or mistakable.
run_on $'x,y,z\n0,0,1\n1,0,-99999\n1,1,3\n0,1,4\n' triangulate -q - -o missing.ply; exits 0
run raster missing.ply -o out.tif --resolution 0.25
exits 0
prints_line '^empty +6$'
says '--vertex-nodata none would treat it as a value'
run raster -q missing.ply -o out.tif --resolution 0.25 --vertex-nodata none; prints ''; exits 0
run raster square.off -o out.tif --resolution 0.5 --nodata 1
exits 0
says 'warning: 2 of its pixels have the value of --nodata'
run raster square.off -o out.tif --nodata x
refused 2 "'--nodata' must be a number that a pixel can have"
run raster square.off -o out.tif --nodata -1 --derive hillshade
refused 2 "'--nodata' must be a number that a pixel can have"
run raster -q square.off -o out.img --driver ENVI --type float64 \
    --extent -1,-1,2,2 --resolution 1 --outside nearest
exits 0
holds "nearest points of the border" test "$(raw d out.img | xargs)" == "1 1.5 2 0.5 1 1.5 0 0.5 1"
run_on $'x,y,z\n0,0,1\n1,0,1\n0,1,1\n1,1,1\n50,0.5,1\n' triangulate -q - -o far.ply; exits 0
run raster far.ply -o out.tif --resolution 0.5 --max-edge 5
exits 0
prints_line '^peeled +1$'
prints_line '^extent +0 0 1 1$'
run raster -q far.ply -o out.img --driver ENVI --resolution 0.5 --max-edge 5 --derive triangle
exits 0
run locate -q --only-answers far.ply <(centres 0 1 0.5 2 2); exits 0
holds "triangles keep their numbers" \
    test "$(raw l out.img | xargs)" == "$(cut -d, -f4 "$logs/out" | tail -n +2 | xargs)"
run raster far.ply -o out.tif --max-edge 0.1; refused 3 'no triangle is left'

# Formats, and what cannot be written.
for output in out.asc out.png out.bil; do
    run raster square.off -o $output --resolution 0.25 --derive hillshade; exits 0; says_nothing
done
holds "text" grep -q '^ncols *4' out.asc
# Rows that are blocks of the file, and a format that is copied from such a file.
wide=(random.ply -q --resolution 0.04 --extent 0,40,100,42 --nodata -9999)
run raster "${wide[@]}" -o wide.asc; exits 0
run raster "${wide[@]}" -o wide.img --driver ENVI; exits 0
tail -n +7 wide.asc | tr -s ' ' '\n' | grep . >wide.txt
holds "a wide raster as text" same_text <(as_floats <wide.txt) <(raw f wide.img)
run raster "${wide[@]}" -o wide.tif; exits 0
holds "the rows of a GeoTIFF" perl -e 'local $/; open my $t, "<:raw", "wide.tif";
    open my $i, "<:raw", "wide.img"; exit(index(<$t>, <$i>) < 0)'
run raster square.off -o out.tif --creation COMPRESS=DEFLATE,TILED=YES; exits 0
run raster square.off -o bad.tif --creation COMPRESS=NO_SUCH; refused 4 'bad\.tif: GDAL says: '
absent bad.tif
run raster absent.off -o out.xyzzy; refused 2 'out\.xyzzy: no raster format has this ending'
run raster absent.off -o out.tif --driver Nothing
refused 2 "this GDAL does not write rasters as 'Nothing'"
run raster absent.off -o absent/out.tif; refused 4 'absent/out\.tif: No such file'
run raster absent.off; refused 2 'a raster is written to a file: -o DEM\.tif'
# A file takes the place of a file, never of a device.
mkfifo pipe.tif
run raster absent.off -o pipe.tif; refused 4 'pipe\.tif: is not a regular file, which GDAL needs'
ln -s pipe.tif link.gpkg
run contours absent.off --levels 1 -o link.gpkg; refused 4 'link\.gpkg: is not a regular file'
holds 'pipes stay' test -p pipe.tif -a -p link.gpkg
rm pipe.tif link.gpkg
run raster absent.off -o out.tif --crs nowhere; refused 2 "'--crs' must be a coordinate system"
run raster square.off -o square.off --driver GTiff; refused 2 'square\.off'
printf '%s\n' "$overlap" >overlap.off
run raster overlap.off -o bad.tif; refused 3 "'meshwalk check overlap\.off' lists every defect"
absent bad.tif
holds "no temporary directory is left" test -z "$(find . -name '.meshwalk*')"
# Means over pixels: exact clipping, so that sums are kept whatever the pixels are; of a plane the
# value at the centre. test_remap holds the clipping against an oracle.
run raster square.off -q --mean -o mean.img --driver ENVI --type float64 --resolution 0.25; exits 0
run raster square.off -q -o centre.img --driver ENVI --type float64 --resolution 0.25; exits 0
holds 'means of a plane' test -z "$(paste <(raw d mean.img) <(raw d centre.img) |
    awk '$1 - $2 > 1e-14 || $2 - $1 > 1e-14')"
run volume random.ply --base -1000; exits 0
net=$(awk '$1 == "net" { net = $2 } $1 == "area" { area = $2 }
    END { printf "%.10g", net - 1000 * area }' "$logs/out")
for size in 0.9 7 60; do
    run raster random.ply --mean -o mean.img --driver ENVI --type float64 --resolution $size
    exits 0
    says_nothing
    holds "the integral at $size is that of the mesh" test "$(awk '$1 == "integral" {
        printf "%.10g", $2 }' "$logs/out")" == "$net"
    cp mean.img all.img
    run raster -q random.ply --mean -o mean.img --driver ENVI --type float64 --resolution $size \
        --threads 1
    holds 'no mean depends on threads' same_text mean.img all.img
done
# The integral of means, also of what is derived: slopes of a plane times its area.
run raster square.off --mean --derive slope -o mean.tif --resolution 0.25; exits 0
prints_line '^integral +54\.7356'
run raster square.off --mean --derive aspect -o mean.tif --resolution 0.25; exits 0
holds 'no integral of aspects' test -z "$(grep integral "$logs/out")"
# Longitudes counted from another meridian: means meet, centres do not, and a warning says so.
printf '%s\n' OFF '4 2 0' '170 -10 1' '190 -10 1' '190 10 1' '170 10 1' \
    '3 0 1 2' '3 0 2 3' >seam.off
seam=(seam.off --crs EPSG:4326 --resolution 10 --driver ENVI -o seam.img)
run raster "${seam[@]}" --extent=-180,-10,180,10; exits 0
says 'warning: its longitudes are from 170 to 190, .* with 360 degrees more have no value'
prints_line '^with value +2$'
run raster "${seam[@]}" --extent=-180,-10,180,10 --mean; exits 0
says_nothing
prints_line '^with value +4$'
run raster "${seam[@]}" --extent=160,-10,200,10; exits 0
says_nothing

# The same mesh with longitudes that end at 180, which is cut there.
run raster -q seam.off --crs EPSG:4326 --resolution 10 --driver ENVI --type float64 -o whole.img \
    --extent=-180,-10,180,10 --mean
exits 0
sed 's/^190 /-170 /' seam.off >cut.off
run raster cut.off --crs EPSG:4326 --resolution 10 --driver ENVI --type float64 -o cut.img \
    --extent=-180,-10,180,10 --mean
exits 0
says_nothing
prints_line '^with value +4$'
holds 'means at the seam' test "$(paste <(raw d cut.img) <(raw d whole.img) | awk '{
    d = $1 - $2; n += $1 == "empty" ? $2 == "empty" : d < 1e-13 && d > -1e-13 } END { print n }')" \
    == 72
run raster cut.off --crs EPSG:4326 --mean --max-edge 90 -o cut.tif
refused 3 'cut.off: crosses the meridian of 180 degrees, or a pole: --max-edge'
# The globe, with vertices at the poles, and with the poles inside of triangles: latitudes are
# their own means round a circle of latitude, and what is 5 everywhere stays so.
printf '%s\n' OFF '6 8 0' '0 0 0' '90 0 0' '180 0 0' '-90 0 0' '17 90 90' '5 -90 -90' \
    '3 0 1 4' '3 1 2 4' '3 2 3 4' '3 3 0 4' '3 1 0 5' '3 2 1 5' '3 3 2 5' '3 0 3 5' >octa.off
printf '%s\n' OFF '6 8 0' '10 60 5' '130 60 5' '-110 60 5' '70 -45 5' '-170 -45 5' \
    '-50 -45 5' '3 0 1 2' '3 5 4 3' '3 0 3 1' '3 1 3 4' '3 1 4 2' '3 2 4 5' '3 2 5 0' \
    '3 0 5 3' >caps.off
globe=(--crs EPSG:4326 --driver ENVI --type float64 --mean --resolution 45 --extent=-180,-90,180,90)
run raster caps.off "${globe[@]}" -o globe.img
exits 0
prints_line '^with value +32$'
prints_line '^integral +62\.83185307'
holds 'five everywhere' test "$(raw d globe.img | awk '{ d = $1 - 5; n += d < 1e-13 && d > -1e-13 }
    END { print n }')" == 32
run raster octa.off "${globe[@]}" -o globe.img
exits 0
prints_line '^with value +32$'
holds 'latitudes' test "$(raw d globe.img | awk '{ row = int((NR - 1) / 8); low = 45 - 45 * row
    n += $1 > low && $1 < low + 45 } END { print n }')" == 32
sed '$d' octa.off | sed 's/^6 8 0/6 7 0/; s/^90 0 /90 20 /; s/^3 0 1 4/3 0 1 3/' >odd.off
run raster odd.off "${globe[@]}" -o globe.img
refused 3 'odd.off: goes round the globe and was cut at the meridian of'

# Half a pixel is covered: the mean over that half. A corner without a value: none.
printf '%s\n' OFF '4 2 0' '0 0 1' '1 0 1' '0 1 4' '-1 0 nan' '3 0 1 2' '3 0 2 3' >half.off
run raster half.off --mean -o mean.img --driver ENVI --type float64 --resolution 1; exits 0
prints_line '^with value +1$'
prints_line '^integral +1$'
holds 'a half pixel' test "$(raw d mean.img | xargs)" == 'empty 2'
run raster square.off --mean --outside nearest -o x.tif; refused 2 'cannot be used with --mean'
run raster square.off --mean --derive slope,triangle -o x.tif
refused 2 'a mean of triangle numbers'
# Means of what is derived: two planes that fall to the south and to the west, by 45 degrees each;
# then one of them is horizontal, and has no aspect.
printf '%s\n' OFF '4 2 0' '0 0 0' '1 0 0' '1 1 1' '0 1 0' '3 0 1 2' '3 0 2 3' >fold.off
run raster -q fold.off --mean --derive slope,aspect -o mean.img --driver ENVI --type float64 \
    --resolution 1
exits 0
holds 'means of slope and aspect' test "$(raw d mean.img | awk '{ printf "%.6f ", $1 }')" == \
    '45.000000 225.000000 '
printf '%s\n' OFF '4 2 0' '0 0 0' '1 0 0' '1 1 0' '0 1 -1' '3 0 1 2' '3 0 2 3' >fold.off
run raster -q fold.off --mean --derive slope,aspect -o mean.img --driver ENVI --type float64 \
    --resolution 1
exits 0
holds 'a horizontal half' test "$(raw d mean.img | awk '{ printf "%.4f ", $1 }')" == \
    '27.3678 315.0000 '

finish
