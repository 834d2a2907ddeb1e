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
    prints_line '^triangles +4$'; prints_line '^convex +yes$'; prints_line '^delaunay +yes$'
    prints_line '^area +4$'
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
for name in m.xyzzy m m.ply.gz; do
    run triangulate absent.xyz -o "$name"
    refused 2 "$name: (.*--format|gzip is read, but not written)"
    absent "$name"
done
run triangulate p.xyz --format off -o m.xyzzy; exits 0
holds "m.xyzzy is OFF" same_text m.xyzzy m.off

# Columns and fields.
printf 'id,height,north,east,salt\n1,5,0,0,9\n2,5,0,1,8\n3,6,1,0,7\n' >table.csv
run triangulate table.csv --columns east,north,height,salt -o t.ply; exits 0
run info t.ply; prints_line '^heights +yes$'; prints_line '^height range +5 6$'
prints_line '^fields +salt$'
run_on $'0 0\n1 0\n' sample t.ply - --field salt; exits 0; prints $'x,y,salt\n0,0,9\n1,0,8'
run triangulate table.csv --columns east,north,depth -o u.ply; refused 3 "no column 'depth'"
absent u.ply

# Which columns are read is found by names, or asked for; what is text elsewhere does no harm.
table() { # table TEXT: a table of four points, triangulated
    printf '%b' "$1" >t.csv
    run triangulate t.csv -o t.ply
}
table 'id,x,y,height,crew,temp\nB1,0,0,10,2,NA\n2,1,0,11,3,5.5\n3,0,1,12,four,-\n4,1,1,13,-,\n'
exits 0; prints_line '^heights +height$'; prints_line '^fields +temp$'
says "^meshwalk: t\.csv: column 'crew' becomes no field: texts stand there, the first in line 4$"
run_on '0 0' sample t.ply - --field temp; prints 'x,y,temp
0,0,'
run triangulate -q t.csv -o t.ply; exits 0; says_nothing
run triangulate t.csv --columns x,y,height,crew -o u.ply
refused 3 "t\.csv:4: column 5: 'four' is not a number"
run triangulate t.csv --columns x,y,height -o t.ply; exits 0; says_nothing
prints_line '^fields +none$'
table 'id;x;y;h;name\n1;0,5;0;2,5;A\n2;1,5;0;7;B, 1.5\n3;0;1,5;3;1,2,3\n'
exits 0; says_nothing; prints_line '^heights +h$'; prints_line '^fields +id$'
table 'id;x;y;z;note\n1;0,5;0;2,5;1\n2;1,5;0;7;B, 1.5\n3;0;1,5;3;1.5\n'
exits 0; says "column 'note' becomes no field.*line 3"; prints_line '^heights +z$'
table 'pid,x,y\n1,0,0\n2,0,1\n3,1,0\n'; exits 0; prints_line '^heights +none$'
prints_line '^fields +pid$'
table 'x,y,level\n0,0,1\n2,0,1\n3,1,0\n'; exits 0; prints_line '^heights +level$'
prints_line '^fields +none$'
table 'x,y,temp,salt\n0,0,1,1\n2,0,1,1\n3,1,0,1\n'; exits 0; prints_line '^heights +none$'
prints_line '^fields +temp, salt$'
table 'a,b\n0,0\n2,0\n3,1\n'; exits 0
rm t.ply
table 'id,depth,a,b,c\n1,0,0,3,1\n2,0,1,4,5\n3,1,0,5,6\n'
refused 2 'which of its 5 columns are x,y\?.*id, depth, a.*--columns'
table 'lon,lat,x,y,z\n1,0,0,3,1\n2,0,1,4,5\n3,1,0,5,6\n'; refused 2 'Both x,y and lon,lat fit'
table 'x,y,z\n1,0,0\n2,0,abc\n3,1,0\n'; refused 3 "t\.csv:3: column 3: 'abc' is not a number"
table 'x,y,height\n1,0,0\n2,0,abc\n3,1,0\n'
refused 3 "t\.csv:3: column 'height', the height, has no number there"
absent t.ply

# --max-edge peels the border, opens no hole, and stops at constraints.
for x in 0 1 2 3 4; do for y in 0 1 2 3 4; do [[ $x == 2 && $y == 2 ]] ||
    echo "$x $y 1"; done; done >grid.xyz
run triangulate grid.xyz -q -o all.off; run info all.off; prints_line '^triangles +30$'
cat grid.xyz - >far.xyz <<<'20 2 5'
run triangulate far.xyz --max-edge 1.9 -o near.off; exits 0; prints_line '^triangles +30$'
prints_line '^peeled +[1-9]'
says '^meshwalk: far\.xyz: 1 of its 25 points belong to no triangle any more'
run info near.off; prints_line '^unused vertices +1$'; prints_line '^holes +0$'
prints_line '^area +16$'
run triangulate grid.xyz --max-edge 0.9 -o none.off; refused 3 'grid\.xyz: no triangle is left'
absent none.off
run triangulate grid.xyz --max-edge 1 -o all.off; exits 0; says_nothing; prints_line '^peeled +0$'
printf '{"type":"LineString","coordinates":[[4,0],[20,2],[4,4]]}' >line.json
run triangulate far.xyz --max-edge 1.9 --constraints line.json -o held.off; exits 0
prints_line '^peeled +0$'
run triangulate grid.xyz --max-edge -1 -o none.off; refused 2 "'--max-edge' must be a length"

# No triangulation: a clear message, code 3, and no file.
none() { # none NAME PATTERN TEXT
    printf '%b' "$3" >"$1.xyz"
    for format in ply node; do
        run triangulate "$1.xyz" -o "$1.$format"; refused 3 "$1\.xyz.*$2"; absent "$1.$format"
        absent "$1.ele"
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
run triangulate zero.xyz -o zero.off; exits 0; prints_line '^duplicates +1$'
prints_line '^triangles +1$'

# Existing output survives a failure.
printf 'precious\n' >keep.ply
run triangulate line.xyz -o keep.ply; exits 3
holds "the old file is untouched" test "$(<keep.ply)" == precious

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
run triangulate --kind regular --weight mass weighted.csv -o regular.ply --hidden hidden.csv
exits 0; says_nothing
prints_line '^ *points +9$'; prints_line '^ *duplicates +1$'; prints_line '^ *hidden +1$'
holds "the light points are hidden" test "$(head -4 hidden.csv | xargs)" == 'point 6 7'
run info regular.ply; exits 0; prints_line '^ *vertices +9$'
sed 1d weighted.csv >bare.csv
run triangulate --kind regular --weight c4 bare.csv -o bare.ply; exits 0
run info bare.ply --json; exits 0; prints_line '"triangles": 8'
run triangulate --kind regular --weight z weighted.csv -o by_z.ply -q; exits 0; prints ''
run triangulate --kind regular --columns x,y,mass --weight mass weighted.csv -o taken.ply --json
exits 0
prints_line '"hidden": 1'
run triangulate --kind regular --columns x,y --weight mass weighted.csv -o no.off
refused 3 "no column 'mass' .*--columns"
run triangulate --kind regular --weight weight weighted.csv -o no.off
refused 3 "weighted.csv: --weight: there is no column 'weight'"
run triangulate --kind regular weighted.csv -o no.off; refused 2 'needs --weight COLUMN'
run triangulate --weight mass weighted.csv -o no.off; refused 2 'need --kind regular'
run triangulate --kind regular --weight mass weighted.csv -o no.off --hidden no.off
refused 2 'cannot both go to'
run triangulate --kind regular --weight mass weighted.csv -o no.off --hidden weighted.csv
refused 2 'both input and output'
run triangulate --kind regular --weight mass weighted.csv -o no.off --hidden -
refused 2 '--hidden must be a file'
sed 's/,9$/,nan/' weighted.csv >missing.csv
run triangulate --kind regular --weight mass missing.csv -o no.off
refused 3 'missing.csv: .*weight of point 4 is not finite'
absent no.off
finish
