#!/usr/bin/env bash
# sample --time: values over time, as a row for each step, a column for each step, or at the times
# of the points.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
if "$meshwalk" --version | grep -q 'libnetcdf is not found'; then
    left_out "libnetcdf is not found"
    exit 0
fi

# UGRID, classic netCDF: the unit square cut into two triangles, zeta = 10 time + x + y at the
# vertices at 0, 1 and 3 hours, u at the faces: 1 3, then 2 4, then 5 9.
base64 -d <<'END' | gunzip >flow.nc
H4sIAAAAAAACA31SzU7CQBCmFKRRTIgxxGNjjPGCKZw8CQkE41ETz7Vpt3YT2DXdhYDPwcHH8DF4Bk8ePfoI7tAZSpvAppNvZ/bb
b366w9HYqmTr2FgNTPMpM2jDXsiIUTwOQthXjdV1kjKW3QNe0xjonAylmDOhuRSqgtzWcNzp3t65Lw/PjyOz84BnrAF3FpmGhUbr
yJhrrq8hvjzM+YXaPpgOMB9xm9TDlKkEz2jvTGQYQJUUxz7rM8G1yjQgbk3zXK9GzoHYLD8nbJb0D+bCOYKmmYWd7Myc+qN5lutp
J3KWKldxETK35/W8jtc137bGC6P3CdxYbO9Uy/9I6SDVPhcR20y/tpO3hhpfO/VTPXDWCGM/lRNG2qfA8bV8lxP5hv/pjFw/Mk0J
lXWe59m8CZi3H0qZRlwEmimqc+FuVNowIx9JQrBQ8znXy7ynONc0Zq/pUfT/irhv7eORPyj7V4jXiDcl/x6xjzgo+lsdp6g/aCGe
I17uqccphK3S+7O/V08//0E+QenMAwAA
END
printf '%s\n' id,x,y,t a,0.75,0.25,0.5 b,0.25,0.75,2 c,5,5,1 d,1,1,3 e,0,0,4 >points.csv

run sample flow.nc points.csv --time all; exits 0
prints $'id,x,y,t,time,zeta,u
a,0.75,0.25,0.5,0,1,1\nb,0.25,0.75,2,0,1,3\nc,5,5,1,0,,\nd,1,1,3,0,2,1\ne,0,0,4,0,0,1
a,0.75,0.25,0.5,1,11,2\nb,0.25,0.75,2,1,11,4\nc,5,5,1,1,,\nd,1,1,3,1,12,2\ne,0,0,4,1,10,2
a,0.75,0.25,0.5,3,31,5\nb,0.25,0.75,2,3,31,9\nc,5,5,1,3,,\nd,1,1,3,3,32,5\ne,0,0,4,3,30,5'
says '^meshwalk: flow.nc: remark: 3 of 3 steps; times are in hours since 2020-01-01$'
cp "$logs/out" all.csv
run sample flow.nc points.csv --time 0..2 --threads 2 -q; exits 0; says_nothing
prints "$(<all.csv)"
run sample square.off points.csv --values flow.nc -q; refused 3 'square.off'
run sample flow.nc points.csv --values flow.nc -q; exits 0; prints "$(<all.csv)"

# Several files are one series, if times go on; here they are 4, 5 and 7 hours in the second.
cp flow.nc later.nc
printf '\100\20\0\0\0\0\0\0\100\24\0\0\0\0\0\0\100\34\0\0\0\0\0\0' |
    dd of=later.nc bs=1 seek=920 conv=notrunc status=none
run sample flow.nc points.csv --values flow.nc,later.nc --time all
exits 0
says '^meshwalk: flow.nc: remark: 6 of 6 steps; times are in hours since 2020-01-01$'
prints "$(cat all.csv && tail -n +2 all.csv |
    sed 's/,0,\([^,]*,[^,]*\)$/,4,\1/; t; s/,1,\([^,]*,[^,]*\)$/,5,\1/; t
        s/,3,\([^,]*,[^,]*\)$/,7,\1/')"
run sample flow.nc points.csv --values flow.nc,later.nc --time-column t --field zeta -q
exits 0
prints_line '^e,0,0,4,0$'
cp flow.nc a,b.nc
run sample flow.nc points.csv --values a,b.nc --time all -q
exits 0
prints "$(<all.csv)"
run sample flow.nc points.csv --values later.nc,flow.nc --time all
refused 3 'flow.nc: its first time, 0, is not later than the last one of the file before, 7'
run sample flow.nc points.csv --values flow.nc,none.nc --time all
refused 3 'none.nc: No such file'
run sample flow.nc points.csv --values flow.nc, --time all
exits 3
run sample flow.nc points.csv --values flow.nc,later.nc --time all -o later.nc
refused 2 'later.nc'

run sample flow.nc points.csv --time 1..2 --wide --field u,zeta --status -q; exits 0
prints $'id,x,y,t,u@1,zeta@1,u@3,zeta@3,status
a,0.75,0.25,0.5,2,11,5,31,inside\nb,0.25,0.75,2,4,11,9,31,inside\nc,5,5,1,,,,,outside
d,1,1,3,2,12,5,32,vertex\ne,0,0,4,2,10,5,30,vertex'
run sample flow.nc points.csv --time nearest:1.9 --only-answers --field zeta -q; exits 0
prints $'x,y,time,zeta\n0.75,0.25,1,11\n0.25,0.75,1,11\n5,5,1,\n1,1,1,12\n0,0,1,10'
# Of two that are as near the first counts.
run sample flow.nc points.csv --time nearest:2 --only-answers --field zeta -q; exits 0
prints_line '^0.75,0.25,1,11$'
run sample flow.nc points.csv --time nearest:2.01 --only-answers --field zeta -q; exits 0
prints_line '^0.75,0.25,3,31$'
run sample flow.nc points.csv --time 2..2 --only-answers --field zeta -q; exits 0
prints_line '^0.75,0.25,3,31$'
# Vertices 0 and 2 have both faces, the others one.
run sample flow.nc points.csv --time 0 --field u --recover -q; exits 0
prints $'id,x,y,t,time,u
a,0.75,0.25,0.5,0,1.5\nb,0.25,0.75,2,0,2.5\nc,5,5,1,0,\nd,1,1,3,0,2\ne,0,0,4,0,2'

# Each point at its own time; none before the first or after the last step.
run sample flow.nc points.csv --time-column t -q; exits 0
prints $'id,x,y,t,zeta,u
a,0.75,0.25,0.5,6,1.5\nb,0.25,0.75,2,21,6.5\nc,5,5,1,,\nd,1,1,3,32,5\ne,0,0,4,,'
run sample flow.nc points.csv --time-column t --time 1..2 -q; exits 0
prints $'id,x,y,t,zeta,u
a,0.75,0.25,0.5,,\nb,0.25,0.75,2,21,6.5\nc,5,5,1,,\nd,1,1,3,32,5\ne,0,0,4,,'
printf '%s\n' 'id;x;y;t' 'a;0,75;0,25;0,5' >comma.csv
run sample flow.nc comma.csv --time 0..1 -q; exits 0
prints $'id;x;y;t;time;zeta;u\na;0,75;0,25;0,5;0;1;1\na;0,75;0,25;0,5;1;11;2'
run sample flow.nc points.csv --time 0 --strict -q; exits 1

# By CF, as netCDF; tests/io/test_point_series.c looks into it.
run sample flow.nc points.csv --time all -o series.nc -q; exits 0; says_nothing
run sample flow.nc points.csv --time-column t -o track.nc -q; exits 0; says_nothing
holds "netCDF files" test "$(head -c 4 series.nc track.nc | grep -c HDF)" == 2
holds "they say how they were made" \
    grep -aq 'meshwalk [0-9.]*: values of flow.nc at the points of points.csv' series.nc
run sample flow.nc points.csv --time all --status -o other.nc; refused 2 '--status is for tables'
run sample flow.nc points.csv --time all --wide -o other.nc; refused 2 '--wide is for tables'
run sample flow.nc points.csv --time all -q -o none/other.nc; refused 4 'none/other.nc: '
holds "nothing is written then" test ! -e other.nc

# As bands of a raster: each pixel is what its centre is as a point. Values of faces, too.
printf '%s\n' x,y 0.25,0.75 0.75,0.75 0.25,0.25 0.75,0.25 >centres.csv
run raster flow.nc -o bands.img --driver ENVI --time all --resolution 0.5 --type float64
if grep -Eq 'built with GDAL|cannot be loaded' "$logs/err"; then
    left_out 'GDAL is not found: no rasters over time'
else
    exits 0
    says 'remark: 3 of 3 steps; times are in hours since 2020-01-01'
    prints_line '^bands +6$'
    run sample flow.nc centres.csv --time all --only-answers -q; exits 0
    # rows of a step: zeta and u at each point; bands: each field at all points
    awk -F, 'NR > 1 { z = z $4 "\n"; u = u $5 "\n"; if (NR % 4 == 1) { printf "%s%s", z, u; z = u = "" } }' \
        "$logs/out" >asked
    holds 'bands are steps and fields' same_text \
        <(perl -e 'local $/; open my $h, "<:raw", "bands.img"; print "$_\n" for unpack "d*", <$h>') \
        asked
    holds 'bands are named' grep -q 'zeta@0' bands.hdr
    holds 'bands are named' grep -q 'u@3' bands.hdr
    # Their means over the whole square.
    run raster flow.nc -q -o means.img --driver ENVI --time all --mean --resolution 1 --type float64
    exits 0
    holds 'means over time' test "$(perl -e 'local $/; open my $h, "<:raw", "means.img";
        print join " ", map { sprintf "%.9g", $_ } unpack "d*", <$h>')" == '1 2 11 3 31 7'
    run raster flow.nc -q -o mean.img --driver ENVI --time 1 --field u --mean --resolution 0.5 \
        --type float64 --max-edge 9
    exits 0
    holds 'means of faces' test "$(perl -e 'local $/; open my $h, "<:raw", "mean.img";
        print join " ", unpack "d*", <$h>')" == '4 3 3 2'
    run raster flow.nc -q -o one.tif --time nearest:1.9 --field zeta --creation COMPRESS=DEFLATE
    exits 0
    says_nothing
    run raster flow.nc -o one.tif --time 7; refused 3 'there is no step 7'
    run raster flow.nc -o one.tif --time x; refused 2 "'--time' must be all"
    run raster flow.nc -o one.tif --values flow.nc; refused 2 '--values needs --time'
    run raster flow.nc -o one.tif --time 1 --derive slope; refused 2 'cannot be used with --time'
fi

# On the globe: an octahedron of longitudes and latitudes, which the plane folds; and without two
# of its facets.
nodes=$'1 0 0 1\n2 90 0 1\n3 180 0 1\n4 -90 0 1\n5 0 90 1\n6 0 -90 1'
facets=$'1 3 1 2 5\n2 3 2 3 5\n3 3 3 4 5\n4 3 4 1 5\n5 3 2 1 6\n6 3 3 2 6\n7 3 4 3 6\n8 3 1 4 6'
borders=$'0\n0\n0\n0'
printf '%s\n' globe '8 6' "$nodes" "$facets" "$borders" >fort.14
printf '%s\n' ocean '6 6' "$nodes" "$(head -n 6 <<<"$facets")" "$borders" >ocean.14
printf '%s\n' globe '2 6 3600 1 1' '0 0' '1 1' '2 3' '3 5' '4 7' '5 9' '6 0' \
    '3600 1' '1 11' '2 13' '3 15' '4 17' '5 19' '6 10' >fort.63
printf '%s\n' lon,lat 0,0 90,0 45,0 180,90 -135,-10 720,0 1,91 >places.csv
run sample --as star --lonlat fort.14 places.csv --values fort.63 --time all --status -q
exits 0; says_nothing
prints_line '^0,0,0,1,vertex$'; prints_line '^90,0,0,3,vertex$'; prints_line '^180,90,0,9,vertex$'
prints_line '^45,0,0,(2|1\.9999[0-9]*|2\.0000[0-9]*),edge$'
prints_line '^45,0,3600,(12|11\.9999[0-9]*|12\.0000[0-9]*),edge$'
prints_line '^-135,-10,3600,[0-9.]+,inside$'
prints_line '^720,0,0,1,vertex$'; prints_line '^1,91,0,,bad$'
sed -E '/^-135,-10/s/,[0-9.]+,inside$/,,outside/' "$logs/out" >wanted.csv
run sample --as star --lonlat --open ocean.14 places.csv --values fort.63 --time all --status -q
exits 0; says_nothing; prints "$(<wanted.csv)"
run sample --as star --lonlat ocean.14 places.csv --values fort.63 --time all -q
refused 3 'ocean.14: triangle .: edge . has no neighbour'
run sample fort.14 places.csv --values fort.63 --time all; refused 3 'fort.14: triangle '
run sample --as star fort.14 places.csv --values fort.63 --time all; refused 2 'need --lonlat'
run sample --as star --lonlat --centre 0,0,0.1 fort.14 places.csv --values fort.63 --time all
refused 2 'leave out --centre'
run sample --as star --lonlat --walk straight fort.14 places.csv --values fort.63 --time all
refused 2 "'--walk' cannot be used with --as star"
run sample --as star --lonlat --wide --field depth fort.14 places.csv
refused 2 "'--wide' needs --time"

# What is refused.
run sample flow.nc points.csv --time 7; refused 3 'flow.nc: has 3 steps, from 0: there is no step 7'
for time in x 2..1 1.. nearest: nearest:nan -1; do
    run sample flow.nc points.csv "--time=$time"; refused 2 "'--time' must be all, FIRST..LAST or N"
done
run sample flow.nc points.csv --time all --field zeta,w
refused 3 "flow.nc: has no field 'w' over time; --field may be of: zeta u"
run sample flow.nc points.csv --field zeta
refused 3 "flow.nc: 'zeta' has values over time; 'meshwalk sample --time all' takes them"
run sample flow.nc points.csv --field w; refused 3 'nothing to sample'
run sample flow.nc points.csv --time all --outside nearest
refused 2 "'--outside' cannot be used with values"
run sample flow.nc points.csv --time-column t --wide; refused 2 '--wide is for --time'
run sample flow.nc points.csv --time-column hour -q; refused 2 'which of its 4 columns are x,y,hour'
printf '%s\n' 'OFF' '3 1 0' '0 0 0' '1 0 0' '0 1 0' '3 0 1 2' >three.off
run sample three.off points.csv --values flow.nc; refused 3 'flow.nc'
run sample flow.nc points.csv --time all -o flow.nc; refused 2 'flow.nc'
finish
