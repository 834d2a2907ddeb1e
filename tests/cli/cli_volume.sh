#!/usr/bin/env bash
# volume: cut and fill against a height or a mesh; areas of one of them only; what is refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

# A pyramid of height 6 over a square of side 4, and a square of side 4 beside it at height 3, half
# over the pyramid; the same cut otherwise, with a hole.
cat >pyramid.off <<'END'
OFF
5 4 0
0 0 0
4 0 0
4 4 0
0 4 0
2 2 6
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
END
cat >square.off <<'END'
OFF
4 2 0
2 0 3
6 0 3
6 4 3
2 4 3
3 0 1 2
3 0 2 3
END
run volume pyramid.off --base 0; exits 0; says_nothing
prints 'cut                   32
fill                  0
net                   32
area                  16
cut area              16
fill area             0
level area            0'
# Above 3 there is a pyramid of half the size.
run volume pyramid.off --base 1e308; exits 0
prints_line '^fill +inf$'; prints_line '^net +-inf$'; prints_line '^cut +0$'
run volume pyramid.off --base 3; exits 0
prints_line '^cut +4$'; prints_line '^fill +20$'; prints_line '^net +-16$'
prints_line '^cut area +4$'; prints_line '^fill area +12$'
run volume square.off --base 3; exits 0
prints_line '^level area +16$'; prints_line '^cut +0$'; prints_line '^fill +0$'

# Half of that.
run volume --against square.off pyramid.off; exits 0; says_nothing
prints 'cut                   2
fill                  10
net                   -8
area                  8
cut area              2
fill area             6
level area            0
mesh only area        8
against only area     8'
cp "$logs/out" expected
run volume --against square.off pyramid.off --threads 1 -o out.txt; exits 0; prints ''
checks=$((checks + 1)); cmp -s out.txt expected || fail "the report should be in out.txt"
run volume --against square.off pyramid.off --strict; exits 1; prints "$(<expected)"
run volume --against pyramid.off square.off --json; exits 0
prints '{
 "cut": 10,
 "fill": 2,
 "net": 8,
 "area": 8,
 "cut_area": 6,
 "fill_area": 2,
 "level_area": 0,
 "mesh_only_area": 8,
 "against_only_area": 8
}'
run volume --against pyramid.off pyramid.off --strict; exits 0; prints_line '^level area +16$'
run_on "$(<square.off)" volume - --against pyramid.off; exits 0; prints_line '^cut +10$'

# A vertex without a value: its triangles are not there.
sed 's/^6 4 3$/6 4 -99999/' square.off >missing.off
run volume missing.off --base 0; exits 0; prints_line '^area +0$'
says 'missing.off: (remark|warning): .*-99999'
run volume missing.off --base 0 --nodata none; exits 0; prints_line "^area +1(6|5.9999)"

# Nothing in common.
sed 's/^\([0-9]\) \([0-9]\) 3$/1\1 \2 3/' square.off >away.off
run volume pyramid.off --against away.off; exits 0; prints_line '^area +0$'
says 'pyramid.off: warning: it has no area in common with away.off: x 0 to 4'
run volume -q pyramid.off --against away.off; exits 0; says_nothing

# Fields as heights.
{
    printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n'
    printf 'property double z\nproperty double bed\nelement face 1\n'
    printf 'property list uchar int vertex_indices\nend_header\n0 0 5 1\n2 0 5 1\n0 2 5 1\n3 0 1 2\n'
} >water.ply
run volume water.ply --against water.ply --against-field bed; exits 0
prints_line '^cut +8$'; prints_line '^area +2$'
run volume water.ply --base 0 --field absent; refused 3 "has no field 'absent'"

# Systems.
if "$meshwalk" --version | grep -q 'GDAL .*found'; then
    run volume pyramid.off --crs EPSG:2056 --against square.off --against-crs EPSG:2056; exits 0
    says_nothing; prints_line '^unit +metre$'
    run volume pyramid.off --crs EPSG:2056 --against square.off; exits 0
    says 'square.off: warning: its coordinate system is not known, and pyramid.off is in EPSG:2056'
    run volume pyramid.off --crs EPSG:2056 --against square.off --against-crs EPSG:32632
    refused 3 'transform one of them first'
    run volume pyramid.off --crs EPSG:2056+5728 --against square.off --against-crs EPSG:2056+5729
    refused 3 "heights 'LN02 height'? .*transform one of them first"
    run volume pyramid.off --crs EPSG:2056+5728 --against square.off --against-crs EPSG:2056
    exits 0; says 'warning: its coordinate system does not define heights'
    run volume pyramid.off --crs EPSG:4326 --base 0
    refused 3 'pyramid.off: is in longitudes and latitudes \(EPSG:4326.*transform it to a projected'
    run volume pyramid.off --crs EPSG:nix --base 0; refused 2 'crs'
fi

run volume pyramid.off; refused 2 'give either --base Z or --against MESH2'
run volume pyramid.off --base 0 --against square.off; refused 2 'give either --base Z or --against'
run volume pyramid.off --base high; refused 2 "'--base' must be a number, not 'high'"
run volume pyramid.off --base nan; refused 2 "'--base' must be a number"
run volume pyramid.off --base 1 --strict; refused 2 "'--strict' needs --against"
run volume pyramid.off --base 1 --against-crs EPSG:2056; refused 2 "'--against-crs' needs"
run volume pyramid.off --against absent.off; refused 3 'absent.off'
run volume pyramid.off --against square.off -o square.off; refused 2 'square.off'
printf 'OFF\n4 2 0\n0 0 0\n4 0 0\n0 4 0\n1 1 0\n3 0 1 2\n3 0 1 3\n' >overlapping.off
run volume overlapping.off --base 0; refused 3 'overlapping.off'
run volume pyramid.off --against overlapping.off; refused 3 'overlapping.off'
finish
