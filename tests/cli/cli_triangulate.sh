#!/usr/bin/env bash
# triangulate: formats, columns, duplicates, reports, and points that have no triangulation.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
points=$'0 0 0\n2 0 2\n2 2 4\n0 2 2\n1 1 2\n1 1 7\n'
printf '%s' "$points" >p.xyz

for format in off ply ply-ascii node vtk obj stl csv; do
    run triangulate p.xyz --format "$format" -o "m.$format"; exits 0; says_nothing
    prints_line '^points +6$'; prints_line '^duplicates +1$'; prints_line '^triangles +4$'
    holds "m.$format is there" test -s "m.$format"
done
holds "node writes m.ele" test -s m.ele
for mesh in m.off m.ply m.node m.obj m.stl; do
    run info "$mesh"; exits 0
    prints_line '^triangles +4$'; prints_line '^convex +yes$'; prints_line '^delaunay +yes$'; prints_line '^area +4$'
    run check "$mesh"; exits 0; prints_line "^$mesh: an embedding"
    run_on $'0.5 1\n1 1\n' sample "$mesh" -; exits 0
    [[ $mesh == m.stl || $mesh == m.node ]] || prints $'x,y,z\n0.5,1,1.5\n1,1,2'
done

for format in off ply vtk obj stl csv; do
    cp "m.$format" expected
    run triangulate p.xyz -q -o "m.${format^^}" ; exits 0
    holds "the ending tells the format $format" same_text "m.${format^^}" expected
    rm "m.${format^^}"
done

# Streams: the mesh to standard output, the report to standard error.
run_on "$points" triangulate - -o - --format off; exits 0
prints_line '^OFF'; says '^triangles +4$'
cp "$logs/out" streamed.off
holds "both ways give one mesh" same_text streamed.off m.off
run triangulate p.xyz -o - --format ply -q; exits 0; says_nothing
run triangulate p.xyz -q -o q.off; exits 0; says_nothing; prints ''
run triangulate p.xyz --json -o q.off; exits 0; holds "the report is JSON" is_json "$logs/out"
prints_line '"duplicates": 1'
for name in m.xyzzy m m.ply.gz; do run triangulate absent.xyz -o "$name"; refused 2 "$name: .*--format"; absent "$name"; done
run triangulate p.xyz --format off -o m.xyzzy; exits 0; holds "m.xyzzy is OFF" same_text m.xyzzy m.off

# Columns and fields.
printf 'id,height,north,east,salt\n1,5,0,0,9\n2,5,0,1,8\n3,6,1,0,7\n' >table.csv
run triangulate table.csv --columns east,north,height,salt -o t.ply; exits 0
run info t.ply; prints_line '^heights +yes$'; prints_line '^height range +5 6$'; prints_line '^fields +salt$'
run_on $'0 0\n1 0\n' sample t.ply - --field salt; exits 0; prints $'x,y,salt\n0,0,9\n1,0,8'
run triangulate table.csv --columns east,north,depth -o u.ply; refused 3 "no column 'depth'"; absent u.ply

# No triangulation: a clear message, code 3, and no file.
none() { # none NAME PATTERN TEXT
    printf '%b' "$3" >"$1.xyz"
    for format in ply node; do
        run triangulate "$1.xyz" -o "$1.$format"; refused 3 "$1\.xyz.*$2"; absent "$1.$format"; absent "$1.ele"
    done
}
none empty '' ''
none single '' '1 2\n'
none pair '' '0 0\n1 0\n'
none equal '' '3 4\n3 4\n3 4\n3 4\n'
none line '' '0 0\n1 1\n2 2\n3 3\n'
none notfinite '' '0 0\n1 0\n0 nan\n1 1\n'
none three ':2: ' '0 0\n1\n0 1\n'
none word ':3: ' '0 0\n1 0\n0 one\n'
# Negative zero is zero.
printf -- '-0.0 0\n0 -0.0\n1 0\n0 1\n' >zero.xyz
run triangulate zero.xyz -o zero.off; exits 0; prints_line '^duplicates +1$'; prints_line '^triangles +1$'

# Existing output survives a failure.
printf 'precious\n' >keep.ply
run triangulate line.xyz -o keep.ply; exits 3; holds "the old file is untouched" test "$(<keep.ply)" == precious

# Regular: a heavy point in the middle of a square hides the light ones round it.
cat >weighted.csv <<'EOF'
x,y,z,mass
0,0,1,0
8,0,2,0
8,8,3,0
0,8,4,0
4,4,5,9
5,4,6,0
4,3,7,-1
4,4,8,2
2,6,9,0.5
EOF
run triangulate --kind regular --weight mass weighted.csv -o regular.ply --hidden hidden.csv; exits 0; says_nothing
prints_line '^ *points +9$'; prints_line '^ *duplicates +1$'; prints_line '^ *hidden +1$'
holds "the light points are hidden" test "$(head -4 hidden.csv | xargs)" == 'point 6 7'
run info regular.ply; exits 0; prints_line '^ *vertices +9$'
run triangulate --kind regular --weight 4 weighted.csv -o by_number.ply; exits 0
holds "the fourth column is the same" cmp regular.ply by_number.ply
run triangulate --kind regular --weight z weighted.csv -o by_z.ply -q; exits 0; prints ''
run triangulate --kind regular --weight 3 weighted.csv -o by_3.ply -q; exits 0
holds "z is the third" cmp by_z.ply by_3.ply
run triangulate --kind regular --columns x,y,mass --weight mass weighted.csv -o taken.ply --json; exits 0
prints_line '"hidden": 1'
run triangulate --kind regular --columns x,y --weight mass weighted.csv -o no.off; refused 3 "no column 'mass' .*--columns"
run triangulate --kind regular --weight weight weighted.csv -o no.off; refused 3 "weighted.csv: --weight: there is no column 'weight'"
run triangulate --kind regular weighted.csv -o no.off; refused 2 'wants --weight COLUMN'
run triangulate --weight mass weighted.csv -o no.off; refused 2 'about --kind regular'
run triangulate --kind regular --weight mass weighted.csv -o no.off --hidden no.off; refused 2 'cannot both go to'
run triangulate --kind regular --weight mass weighted.csv -o no.off --hidden weighted.csv; refused 2 'input and output'
run triangulate --kind regular --weight mass weighted.csv -o no.off --hidden -; refused 2 'wants a file'
sed 's/,9$/,nan/' weighted.csv >missing.csv
run triangulate --kind regular --weight mass missing.csv -o no.off; refused 3 'missing.csv: .*weight of point 4 is not finite'
absent no.off
finish
