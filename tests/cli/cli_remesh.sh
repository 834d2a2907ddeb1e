#!/usr/bin/env bash
# star --remesh and --onto: polyhedra small enough to know the answers; fields, missing values,
# centres; what is refused, and what is not left behind. sample --as star: fields on a globe.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"

# An octahedron about the origin with f = x + 2y + 3z + 4 and one value that is missing in g.
cat >octahedron.ply <<'END'
ply
format ascii 1.0
element vertex 6
property double x
property double y
property double z
property double f
property double g
element face 8
property list uchar int vertex_indices
end_header
1 0 0 5 1
0 1 0 6 1
-1 0 0 3 1
0 -1 0 2 1
0 0 1 7 nan
0 0 -1 1 1
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
3 1 0 5
3 2 1 5
3 3 2 5
3 0 3 5
END


# --- on an icosphere: vertices on the octahedron, fields exact to rounding, missing values spread
run star octahedron.ply --remesh 3 --format ply-ascii -o out.ply; exits 0; says_nothing
holds "642 vertices" grep -q '^element vertex 642$' out.ply
holds "1280 triangles" grep -q '^element face 1280$' out.ply
holds "vertices and values are where they should be" awk '
    /end_header/ { on = 1; next }
    !on || n == 642 { next }
    { n++; sum = ($1 < 0 ? -$1 : $1) + ($2 < 0 ? -$2 : $2) + ($3 < 0 ? -$3 : $3)
      f = $1 + 2 * $2 + 3 * $3 + 4 - $4
      if (sum - 1 > 1e-15 || 1 - sum > 1e-15 || f > 1e-14 || f < -1e-14) wrong++
      if (($5 == "nan") != ($3 > 0)) wrong++ }
    END { exit wrong > 0 || n != 642 }' out.ply
run check --as star out.ply; exits 0
prints 'out.ply: star-shaped about the centre: every promise holds'

# The same bytes for any number of threads; the icosahedron is level 0.
run star octahedron.ply --remesh 3 --format ply-ascii -o two.ply --threads 3; exits 0
holds "threads make no difference" same_text out.ply two.ply
run star octahedron.ply --remesh 0 -o small.off; exits 0
says 'warning: the format off has no place for fields: f, g'
holds "an icosahedron" test "$(sed -n 2p small.off)" = "12 20 0"

# A number that means missing.
sed 's/ nan$/ -99999/' octahedron.ply >coded.ply
run star coded.ply --remesh 3 --format ply-ascii -o coded_out.ply; exits 0
says "'g'|g.*-99999"
holds "it is missing" same_text out.ply coded_out.ply
run star coded.ply --remesh 3 --nodata none --format ply-ascii -o coded_out.ply -q; exits 0
holds "or a value" grep -q -- '-99999' <(cut -d' ' -f5 coded_out.ply)

# --- another centre: the corner of a cube far from the origin
cat >cube.off <<'END'
OFF
8 12 0
1000 2000 0
1008 2000 0
1000 2008 0
1008 2008 0
1000 2000 8
1008 2000 8
1000 2008 8
1008 2008 8
3 0 2 1
3 1 2 3
3 4 5 6
3 5 7 6
3 0 1 4
3 1 5 4
3 2 6 3
3 3 6 7
3 0 4 2
3 2 4 6
3 1 3 5
3 3 7 5
END
run star cube.off --remesh 2 --centre 1001,2004,2 -o cube_out.off; exits 0; says_nothing
holds "each vertex is on a side" awk '
    NR > 2 && NR <= 164 && ($1 - 1000) * ($1 - 1008) * ($2 - 2000) * ($2 - 2008) * $3 * ($3 - 8) {
        wrong++ }
    END { exit wrong > 0 || NR < 400 }' cube_out.off
run star cube.off --remesh 2 -o none.off; refused 3 'cube.off: triangle .* centre'
says "'meshwalk check --as star cube.off' lists every defect"
absent none.off

# An octahedron of a few roundings: it is star-shaped, but facets of a sixteenth of it fold.
sed 's/+/1.0000000000000018/; s/-/0.99999999999999822/' >tiny.off <<'END'
OFF
6 8 0
+ 1 1
- 1 1
1 + 1
1 - 1
1 1 +
1 1 -
3 0 2 4
3 2 1 4
3 1 3 4
3 3 0 4
3 2 0 5
3 1 2 5
3 3 1 5
3 0 3 5
END
run star tiny.off --remesh 4 --centre 1,1,1 -o folded.off; exits 0
says 'folded.off: warning: rounding folds it, so that it is not star-shaped: triangle '
run check --as star --centre 1,1,1 folded.off; exits 3
run star tiny.off --remesh 4 --centre 1,1,1 -o folded.off -q; exits 0; says_nothing
rm folded.off tiny.off

# --- onto another mesh: its triangles, the vertices on the cube; onto itself nothing moves
run star cube.off --centre 1001,2004,2 --onto cube_out.off -o again.off; exits 0; says_nothing
holds "the same triangles" same_text <(tail -n 320 cube_out.off) <(tail -n 320 again.off)
run star cube.off --centre 1001,2004,2 --onto cube.off -o itself.off; exits 0; says_nothing
holds "nothing moves" same_text cube.off itself.off
run star octahedron.ply --onto out.ply --format ply-ascii -o onto.ply; exits 0
says 'out.ply: warning: its fields are not written: the values are those of octahedron.ply'
run star octahedron.ply --onto cube.off -o none.off; refused 3 'cube.off: triangle .* centre'
absent none.off

# --- the report
run star octahedron.ply --remesh 4 -o fine.ply --deviation --json; exits 0
prints ''
holds "it is JSON" is_json "$logs/err"
holds "bounds are in order" perl -MJSON::PP -e 'local $/; my $r = JSON::PP->new->decode(<STDIN>);
    exit !($r->{vertices} == 2562 && $r->{triangles} == 5120 && $r->{out_largest} > 0.01
        && $r->{out_mean} < $r->{out_largest} && $r->{out_largest} <= $r->{out_at_most}
        && $r->{hausdorff_at_least} == ($r->{out_largest} > $r->{polyhedron_largest}
            ? $r->{out_largest} : $r->{polyhedron_largest})
        && $r->{hausdorff_at_least} < $r->{hausdorff_at_most}
        && $r->{hausdorff_at_most} < 0.1)' <"$logs/err"
run star octahedron.ply --onto octahedron.ply -o same.ply --deviation -q; exits 0
says '^hausdorff at most +[0-9.]+e-1[5-9]$|^hausdorff at most +0$'

# --- what is refused; nothing is left behind
mkdir refusals && cd refusals || exit 1
for words in '--remesh 13' '--remesh -1' '--remesh two' '--remesh 1.5' '--remesh 0x3'; do
    # shellcheck disable=SC2086
    run star ../octahedron.ply $words -o out.off
    refused 2 "'--remesh' must be a number from 0 to 12"
done
run star ../octahedron.ply --remesh 2; refused 2 '-o MESH is missing'
run star ../octahedron.ply --remesh 2 -o out.xyz; refused 2 'no mesh format has this ending'
run star ../octahedron.ply --remesh 2 --onto ../cube.off -o out.off; refused 2 'not both'
run star ../octahedron.ply rays.csv --remesh 2 -o out.off
refused 2 "'rays.csv' is one file too many"
run star ../octahedron.ply --remesh 2 --walk straight -o out.off
refused 2 "'--walk' is for DIRECTIONS"
run star ../octahedron.ply --remesh 2 --stats -o out.off; refused 2 "'--stats' is for DIRECTIONS"
run star ../octahedron.ply --deviation rays.csv
refused 2 "'--deviation' needs --remesh or --onto"
run star ../octahedron.ply --nodata 3 rays.csv; refused 2 "'--nodata' needs --remesh or --onto"
run star ../octahedron.ply; refused 2 'expected POLYHEDRON DIRECTIONS'
run star ../octahedron.ply --remesh 2 -o ../octahedron.ply; refused 2 'octahedron.ply'
run star ../octahedron.ply --onto missing.off -o out.off; refused 3 'missing.off'
head -n 9 ../cube.off >broken.off
run star broken.off --remesh 2 -o out.off; refused 3 'broken.off'
sed -e '2s/12/11/' -e '$d' ../cube.off >open.off
run star open.off --centre 1001,2004,2 --remesh 2 -o out.off; refused 3 'open.off: .*edge'
run star ../octahedron.ply --remesh 2 -o missing/out.off; exits 4
only_files broken.off open.off
cd .. || exit 1

# --- sample --as star: f is linear in x, y, z on each facet
printf 'name,x,y,z\na,1,0,0\nb,2,2,4\nc,0,0,-3\nd,0,0,0\ne,0,1,1\n' >rays.csv
run sample octahedron.ply rays.csv --as star --field f; exits 0; says_nothing
prints 'name,x,y,z,f
a,1,0,0,5
b,2,2,4,6.25
c,0,0,-3,1
d,0,0,0,
e,0,1,1,6.5'
run sample octahedron.ply rays.csv --as star --field g --status; exits 0
prints 'name,x,y,z,g,status
a,1,0,0,1,vertex
b,2,2,4,,missing
c,0,0,-3,1,vertex
d,0,0,0,,bad
e,0,1,1,,missing'
run sample octahedron.ply rays.csv --as star --field g --missing nearest --strict; exits 1
prints 'name,x,y,z,g
a,1,0,0,1
b,2,2,4,1
c,0,0,-3,1
d,0,0,0,
e,0,1,1,1'

# A globe of longitudes and latitudes whose first and last columns are one, with the value
# lat + 10 cos(lon): across the seam and at the poles.
awk 'BEGIN {
    print "# attributes: t"
    print 37 * 19, 2, 1, 0
    for (y = -90; y <= 90; y += 10) for (x = -180; x <= 180; x += 10) {
        c = cos(x * atan2(0, -1) / 180);
        print n++, x, y, (y == 90 || y == -90) ? y : y + 10 * c } }' >globe.node
awk 'BEGIN {
    print 2 * 36 * 18, 3, 0
    for (j = 0; j < 18; j++) for (i = 0; i < 36; i++) {
        a = 37 * j + i; print t++, a, a + 1, a + 38; print t++, a, a + 38, a + 37 } }' >globe.ele
printf 'lon,lat\n180,10\n-180,10\n540,10\n77,90\n-3,-90\n179.5,12\n-180.5,12\n' >places.csv
run sample globe.node places.csv --as star --lonlat --field t; exits 0; says_nothing
holds "seam and poles" awk -F, '
    NR == 1 { next } { v[NR] = $3 }
    END { exit !(v[2] == 0 && v[3] == 0 && v[4] == 0 && v[5] == 90 && v[6] == -90 && v[7] == v[8] &&
                 v[7] > 1.8 && v[7] < 2.5) }' "$logs/out"
run sample globe.node places.csv --as star --lonlat --field t --threads 3; exits 0
run sample globe.node places.csv --as star --field t; refused 3 'has no z; --lonlat takes x and y'
run sample octahedron.ply rays.csv --as star; refused 2 'needs --field NAME'
run sample octahedron.ply rays.csv --as star --field h
refused 3 "no field 'h'; --field may be one of: z f g"
run sample octahedron.ply rays.csv --as star --field f --outside nearest
refused 2 "'--outside' cannot be used with --as star"
run sample octahedron.ply rays.csv --as star --field f --time all
refused 2 'values over time on --as star need --lonlat'
run sample octahedron.ply rays.csv --field f --lonlat; refused 2 "'--lonlat' needs --as star"
run sample octahedron.ply rays.csv --field f --centre 1,2,3; refused 2 "'--centre' needs --as star"
run sample cube.off rays.csv --as star --field z; refused 3 'cube.off: triangle .* centre'

# A remeshed globe has the field of the globe.
run star globe.node --lonlat --remesh 5 --format ply -o globe.ply; exits 0; says_nothing
run sample globe.ply places.csv --as star --lonlat --field t; exits 0
holds "near the values of the globe" awk -F, '
    NR == 1 { next } { v[NR] = $3 }
    END { exit !(v[2] * v[2] < 0.2 && v[5] > 88 && v[6] < -88 && v[7] > 1.6 &&
        v[7] < 2.6) }' "$logs/out"

finish
