#!/usr/bin/env bash
# weights and apply: files of weights, and fields interpolated by them.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >square.off
points=$'0.75 0.25\n1 1\n2 0.5\nnan 0\n'

# A sparse matrix needs no library.
run_on "$points" weights square.off - -o w.npz --stats; exits 0; prints ''
says '^points +4$'; says '^inside +1$|^edge +1$'; says '^outside +1$'; says '^bad +1$'
says '^vertices +4$'; says '^weights +[1-4]$'
holds "an archive" test "$(head -c 2 w.npz)" == PK
run_on "$points" weights square.off - -o w.npz --strict; exits 1
run_on "$points" weights square.off - -o w.npz --stats --json; exits 0; says '"outside": 1'

# What is refused, and what is left behind: nothing.
run_on "$points" weights square.off -; refused 2 'weights needs an output'
run_on "$points" weights square.off - -o square.off; refused 2 'square.off'
run_on "$points" weights square.off - -o none/w.npz; refused 4 'none/w.npz: '
run_on "$points" weights none.off - -o w2.npz; refused 3 'none.off: '
run apply w.npz w.npz; refused 2 'apply needs an output'
run apply w.npz w.npz -o w.npz; refused 2 'w.npz'
holds "nothing else was written" test "$(echo *)" == 'square.off w.npz'

# A full disk is told as such, also by netCDF: here by a limit of 40 KiB.
if "$meshwalk" --version | grep -q 'netCDF .*found'; then
    awk 'BEGIN { for (i = 0; i < 9000; i++) print 0.25, i / 9000 }' >many.txt
    last='weights, with no room for a file of 40 KiB'
    (trap '' XFSZ; ulimit -f 40; exec "$meshwalk" weights square.off many.txt -o w3.nc) \
        >"$logs/out" 2>"$logs/err"
    code=$?; refused 4 'w3.nc: File too large$'
    rm many.txt
    only_files square.off w.npz
fi

# To cells: two triangles, a mesh of the same square moved by half, and no points' options.
sed 's/^\(0\|1\) \(0\|1\) /\1.5 \2 /' square.off >moved.off
conservative="--method conservative"
run weights square.off square.off $conservative -o same.npz --stats; exits 0; prints ''
says '^target cells +2$'; says '^common area +1$'
run weights square.off moved.off $conservative -o part.npz; exits 0
says 'square.off: remark: 50 % of its area lies outside moved.off: sums over it are not conserved'
run weights square.off moved.off $conservative -o part.npz -q --strict; exits 1; says_nothing
run weights square.off square.off $conservative --values vertices --stats --json -o v.npz; exits 0
says '"source_vertices": 4'; says '"weights": 8|"weights": 6'
run weights square.off square.off $conservative; refused 2 'weights needs an output|wants an output'
run weights square.off square.off $conservative -o square.off; refused 2 'square.off'
run weights square.off square.off $conservative --columns 1,2 -o x.npz
refused 2 "'--columns' is for points"
run_on "$points" weights square.off - --norm fracarea -o x.npz; refused 2 "'--norm' needs"
run weights square.off none.off $conservative -o x.npz; refused 3 'none.off'
run weights square.off none.tif $conservative -o x.npz; refused 3 'none.tif'
sed 's/^\(0\|1\) 1 /\1 95 /; s/^1 2$/1 2/' square.off >pole.off
if "$meshwalk" --version | grep -q 'GDAL .*found'; then
    run weights pole.off square.off $conservative --crs EPSG:4326 --points-crs EPSG:4326 -o x.npz
    refused 3 'pole.off, square.off: latitudes from 0 to 95 are out of range, which is -90 to 90 degrees'
    run weights square.off square.off $conservative --crs EPSG:4326 --points-crs EPSG:2056 -o x.npz
    refused 3 'transform one of them first'

    # Round the globe: an octahedron with its vertices at the poles; two caps with the poles inside,
    # and a ring of triangles between them; the same counted from 0 to 360; a cap of four corners.
    degrees="$conservative --crs EPSG:4326 --points-crs EPSG:4326 --stats"
    printf '%s\n' OFF '6 8 0' '0 0 0' '90 0 0' '180 0 0' '-90 0 0' '17 90 0' '5 -90 0' \
        '3 0 1 4' '3 1 2 4' '3 2 3 4' '3 3 0 4' '3 1 0 5' '3 2 1 5' '3 3 2 5' '3 0 3 5' >octa.off
    printf '%s\n' OFF '6 8 0' '10 60 0' '130 60 0' '-110 60 0' '70 -45 0' '-170 -45 0' \
        '-50 -45 0' '3 0 1 2' '3 5 4 3' '3 0 3 1' '3 1 3 4' '3 1 4 2' '3 2 4 5' '3 2 5 0' \
        '3 0 5 3' >caps.off
    sed 's/^-110 /250 /; s/^-170 /190 /; s/^-50 /310 /' caps.off >caps360.off
    printf '%s\n' OFF '8 6 0' '-170 60 0' '-80 50 0' '10 50 0' '100 60 0' '-170 -60 0' \
        '-80 -50 0' '10 -50 0' '100 -60 0' '4 0 1 2 3' '4 7 6 5 4' '4 0 4 5 1' '4 1 5 6 2' \
        '4 2 6 7 3' '4 3 7 4 0' >box.off
    {
        printf '%s\n' 'ncols 8' 'nrows 4' 'xllcorner -180' 'yllcorner -90' 'cellsize 45'
        for _ in 1 2 3 4; do echo 1 1 1 1 1 1 1 1; done
    } >globe.asc
    sed 's/^xllcorner -180/xllcorner 20/' globe.asc >turned.asc
    whole() { # the whole sphere is the source, the target and what they have in common
        exits 0
        holds "the sphere is whole ($*)" test 3 == "$(awk '/ area / {
            d = $3 / 12.566370614359172 - 1; n += d < 1e-13 && d > -1e-13 } END { print n }' \
            "$logs/err")"
    }
    # Longitudes that are rounded when turns are added to them, and vertices at the poles.
    awk 'BEGIN { n = 4; print "OFF\n" n + 2, 2 * n, 0
        for (i = 0; i < n; i++) printf "%.15g %.15g 0\n", 77 * i - 77.7, 9 * sin(i)
        print "17 90 0\n5 -90 0"
        for (i = 0; i < n; i++) { print 3, i, (i + 1) % n, n; print 3, (i + 1) % n, i, n + 1 } }' \
        >fans.off
    for source in octa caps caps360 box fans; do
        for target in globe.asc turned.asc octa.off caps.off caps360.off box.off; do
            run weights $source.off $target $degrees -o x.npz; whole $source $target
        done
    done
    # An octant is four of these pixels, and no other.
    run weights octa.off globe.asc $degrees -o x.npz; exits 0; says '^weights +32$'
    run weights caps.off globe.asc $degrees -o x.npz; says '^source cells +8$'
    run weights caps.off globe.asc $degrees --values vertices -o x.npz
    refused 3 'caps.off: crosses the meridian of 180 degrees, or a pole: --values vertices is not'
    sed '$d' octa.off | sed 's/^6 8 0/6 7 0/; s/^90 0 /90 20 /; s/^3 0 1 4/3 0 1 3/' >odd.off
    run weights odd.off globe.asc $degrees -o x.npz
    refused 3 'odd.off: goes round the globe and was cut at the meridian of'
    sed 's/^-110 /-190 /' caps.off >odd.off
    run weights odd.off globe.asc $degrees -o x.npz; refused 3 'longitudes, from -190 to 130, have'
    rm -f octa.off caps.off caps360.off box.off fans.off odd.off globe.asc turned.asc x.npz
fi
rm -f pole.off same.npz part.npz v.npz moved.off

if ! "$meshwalk" --version | grep -q '^  netCDF .*found' ||
    "$meshwalk" --version | grep -q 'libnetcdf is not found'; then
    left_out "libnetcdf is not found"
    finish
fi
# Cells stand at their centroids, a quadrangle at that of its area.
holds_numbers() { # holds_numbers FILE NUMBERS: these doubles stand in it side by side
    perl -e 'local $/; open my $f, "<:raw", shift; my $all = <$f>; my @want = @ARGV;
        for my $at (0 .. length($all) - 8 * @want) {
            my @got = unpack "d<" . @want, substr $all, $at, 8 * @want;
            exit 0 unless grep { !(abs($got[$_] - $want[$_]) < 1e-14) } 0 .. $#want;
        }
        exit 1' "$@"
}
printf '%s\n' OFF '5 2 0' '0 0 0' '4 0 0' '4 1 0' '0 3 0' '7 -3 0' '4 0 1 2 3' '3 1 4 2' >cells.off
run weights $conservative cells.off square.off -o c.nc -q; exits 0
holds "in the plane nothing is in degrees" test -z "$(grep -a degrees c.nc)"
holds "centroids of the source" holds_numbers c.nc 1.6666666666666667 5
holds "centroids of the source" holds_numbers c.nc 1.0833333333333333 -0.66666666666666663
holds "centroids of the target" holds_numbers c.nc 0.66666666666666663 0.33333333333333331
holds "centroids of the target" holds_numbers c.nc 0.33333333333333331 0.66666666666666663
run_on "$points" weights square.off - -o w.nc; exits 0; prints ''; says_nothing
run apply w.npz w.nc -o o.nc; refused 3 'w.npz: this is not a netCDF file'
# A file of weights has fields, too: the coordinates of its vertices, which are linear.
run apply w.nc w.nc --field xc_a,yc_a -o o.nc --stats; exits 0
says 'w.nc: remark: 2 of 4 points have no weights; their values are missing'
says '^fields +2$'; says '^rows +2$'; says '^without weights +2$'
run apply w.nc w.nc --field xc_a -o o.nc -q; exits 0; says_nothing
run apply w.nc w.nc --field xc_a -o o.nc --strict; exits 1
run apply w.nc w.nc --field nope -o o2.nc; refused 3 "w.nc: there is no variable 'nope'"
run apply o.nc w.nc -o o2.nc; refused 3 'o.nc: has no dimension n_a'
run apply w.nc none.nc -o o2.nc; refused 3 'none.nc: '
run apply w.nc w.nc -o none/o2.nc; refused 4 'none/o2.nc: '
head -c 3000 w.nc >cut.nc
run apply cut.nc w.nc -o o2.nc; refused 3 'cut.nc: '
holds "no output of a failure" test ! -e o2.nc

# On the globe: an octahedron of longitudes and latitudes, whole and without two facets.
nodes=$'1 0 0 1\n2 90 0 1\n3 180 0 1\n4 -90 0 1\n5 0 90 1\n6 0 -90 1'
facets=$'1 3 1 2 5\n2 3 2 3 5\n3 3 3 4 5\n4 3 4 1 5\n5 3 2 1 6\n6 3 3 2 6\n7 3 4 3 6\n8 3 1 4 6'
printf '%s\n' globe '8 6' "$nodes" "$facets" 0 0 0 0 >globe.14
printf '%s\n' ocean '6 6' "$nodes" "$(head -n 6 <<<"$facets")" 0 0 0 0 >ocean.14
printf '%s\n' lon,lat 0,0 45,0 170,30 180,30 -170,30 0,90 >places.csv
run weights --lonlat globe.14 places.csv -o w.nc --stats; exits 0
says '^vertex +2$'; says '^edge +2$'; says '^inside +2$'; says '^weights +12$'
mv w.nc whole.nc
run weights --lonlat --open ocean.14 places.csv -o w.nc --stats; exits 0; says '^weights +12$'
holds "weights are those of the whole globe" cmp w.nc whole.nc
printf '%s\n' lon,lat -135,-10 0,0 >places.csv
run weights --lonlat --open ocean.14 places.csv -o w.nc --strict; exits 1
rm w.nc
run weights --lonlat ocean.14 places.csv -o w.nc; refused 3 'edge . has no neighbour'
run weights globe.14 places.csv -o w.nc; refused 3 'globe.14: triangle '
printf '%s\n' OFF '3 1 0' '0 0 5' '90 0 5' '0 80 5' '3 0 1 2' >height.off
run weights --lonlat --open height.off places.csv -o w.nc
refused 3 'height.off: has z, and no coordinate system of longitudes and latitudes'
run weights --open globe.14 places.csv -o w.nc; refused 2 "'--open' needs --lonlat"
run weights --lonlat --start grid globe.14 places.csv -o w.nc
refused 2 "'--start' is for points in the plane, not for --lonlat"
run weights --lonlat --method conservative globe.14 globe.14 -o w.nc
refused 2 "'--lonlat' is for points, not for --method conservative"
absent w.nc
finish
