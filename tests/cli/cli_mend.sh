#!/usr/bin/env bash
# check --fix: what is mended, what is told of it, numbers, values, exit codes.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"

cat >bad.ply <<'END'
ply
format ascii 1.0
element vertex 8
property double x
property double y
property double z
property double depth
element face 5
property list uchar int vertex_indices
end_header
0 0 1 5
4 0 1 6
0 4 1 7
4 0 2 6
4 4 1 8
0 4 1 9
2 2 1 1
9 9 0 0.1
3 0 1 2
3 3 6 4
3 6 4 5
3 4 6 1
3 0 3 1
END
changes='vertex 3: welded to vertex 1
vertex 5: welded to vertex 2
triangle 4: dropped: it has vertex 1 twice
triangle 3: dropped: it has the vertices of triangle 1
triangle 0: split at vertex 6
triangle 1: turned
vertex 3: its z, 2, is lost: that of vertex 1, 1, is kept
vertex 5: its depth, 9, is lost: that of vertex 2, 7, is kept'
sum='bad.ply: vertices: 2 welded, 6 of 8 left; triangles: 2 dropped, 1 split, 1 turned, 4 made of 5; values lost: 2'
good=': an embedding: every promise holds'
run check bad.ply; exits 3
run check --fix weld,orient,drop,split bad.ply -o out.ply --numbers n.csv; exits 0; says_nothing
prints "$changes
$sum
out.ply$good"
holds "the numbers are told" test "$(tr '\n' ' ' <n.csv)" == "what,old,new vertex,0,0 vertex,1,1 vertex,2,2 vertex,3,1 \
vertex,4,3 vertex,5,2 vertex,6,4 vertex,7,5 triangle,0,0 triangle,0,1 triangle,1,2 \
triangle,2,3 triangle,3,-1 triangle,4,-1 "
run check out.ply; exits 0
printf 'x,y\n1,0.5\n1,3.5\n' >p.csv
run sample out.ply p.csv --field depth; exits 0; prints $'x,y,depth\n1,0.5,4.125\n1,3.5,5.625'
run check -q --fix all bad.ply -o out.ply; exits 0; prints "$sum"$'\n'"out.ply$good"
run check --fix all out.ply -o again.ply; exits 0
prints "out.ply: vertices: 0 welded, 6 of 6 left; triangles: 0 dropped, 0 split, 0 turned, 4 made of 4"$'\n'"again.ply$good"
holds "to mend it again changes nothing" cmp out.ply again.ply
run check --fix all bad.ply -o out.off; exits 0
says 'out\.off: warning: the format off has no place for fields: depth is not written'
run check -q --fix all bad.ply -o out.off; exits 0; says_nothing
printf 'x,y,z,q\n0,0,0,0\n1,0,0,0\n0,1,0,0\n' >t.csv
run triangulate t.csv -o t.stl; exits 0
says 't\.stl: warning: the format stl has no place for fields: q is'
run triangulate --columns x,y,z t.csv -o t.stl; exits 0; says_nothing

# What is left is named, in the mended mesh's numbers, and it is written.
run check --fix weld bad.ply -o part.ply; exits 1
prints_line '^vertex 5: welded'; prints_line '^part\.ply: triangle 4: vertex 1 is in it twice'
prints_line '^part\.ply: no embedding: [0-9]+ defects'; holds "it is written" test -s part.ply
printf '%s\n' "$overlap" >overlap.off
run check --fix all overlap.off -o o.off; exits 1; prints_line '^o\.off: triangle [01]: .*crosses'
run check --fix all --json bad.ply -o out.ply; exits 0; holds "it is JSON" is_json "$logs/out"
prints_line '"kind": "split", "triangle": 0, "vertex": 6'
prints_line '"field": "depth", "vertex": 5, "kept": 2'
prints_line '"embedding": true'
run check --fix all --json overlap.off -o o.off; exits 1; holds "it is JSON" is_json "$logs/out"
prints_line '"crossing"'

# Standard streams.
run_on "$(<bad.ply)" check --fix all - -o - --format node; refused 2 "writes two files"
run_on "$(<bad.ply)" check --fix all - -o - --format off; exits 0; prints_line '^OFF'
says '^triangle 0: split'
run check --fix all bad.ply -o out.ply --numbers -; exits 0; prints_line '^vertex,5,2$'
says '^vertex 5: welded'
run check --fix all absent.ply -o none.ply; refused 3 'absent\.ply'; absent none.ply
run check --fix all bad.ply -o none/none.ply; refused 4 'none'
run check --fix all bad.ply -o kept.ply --numbers none/n.csv; refused 4 'none'; absent kept.ply

# Within a tolerance; and a surface, whose z tells vertices apart.
printf 'OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n0.9999999 0 0\n1 1 0\n0 0.9999999 0\n3 0 1 2\n3 3 4 5\n' \
    >near.off
run check --fix all near.off -o n.off; exits 1
run check --fix all --tolerance 1e-6 near.off -o n.off; exits 0
prints_line '^vertex 3: welded to vertex 1$'
printf 'OFF\n6 2 0\n0 0 0\n1 0 0\n0 0 1\n1 0 0\n1 0 1\n0 0 1\n3 0 1 2\n3 3 5 4\n' >wall.off
run check --fix all --as surface wall.off -o w.off; exits 0
prints_line '^triangle [01]: turned$'; prints_line 'vertices: 2 welded, 4 of 6 left'
run check --as surface w.off; exits 0
finish
