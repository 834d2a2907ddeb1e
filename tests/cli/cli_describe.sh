#!/usr/bin/env bash
# info and check: facts, defects with their places, exit codes, JSON.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >square.off
printf '%s\n' "$ring" >ring.off
printf '%s\n' "$overlap" >overlap.off

run info square.off; exits 0; says_nothing
for fact in 'vertices +4' 'unused vertices +0' 'triangles +2' 'flat triangles +0' 'clockwise triangles +0' \
    'oriented +yes' 'clashing edges +0' 'border edges +4' 'border loops +1' 'components +1' 'holes +0' 'low +0 0' \
    'high +1 1' 'area +1' 'embedding +yes' 'convex +yes' 'delaunay +yes' 'heights +yes' 'height range +0 2' \
    'fields +none' 'memory bytes +[1-9][0-9]*'; do
    prints_line "^$fact\$"
done
run info ring.off; exits 0
for fact in 'border edges +8' 'border loops +2' 'holes +1' 'area +8' 'convex +no' 'embedding +yes'; do
    prints_line "^$fact\$"
done
run info overlap.off; exits 0; prints_line '^embedding +no$'; prints_line '^holes +not known'
for mesh in square ring overlap; do
    run info --json $mesh.off; exits 0; holds "info --json $mesh is JSON" is_json "$logs/out"
    run check --json $mesh.off; holds "check --json $mesh is JSON" is_json "$logs/out"
    run info $mesh.off -o info.txt; exits 0; prints ''; holds "info.txt is written" test -s info.txt
done
cp square.off $'a"\\\xff.off'
run info --json $'a"\\\xff.off'; exits 0; holds "a wild name makes good JSON" is_json "$logs/out"

run check square.off; exits 0; prints 'square.off: an embedding: every promise holds'; says_nothing
run check overlap.off; exits 3; says_nothing
prints_line '^triangle [01]: '; prints_line '^overlap\.off: no embedding: [1-9][0-9]* defects?'
run check --json overlap.off; exits 3; prints_line '"kind": "crossing"'; prints_line '"embedding": false'

# One defect of each kind that can be told apart.
defect() { # defect KIND OFF-TEXT
    printf '%b\n' "$2" >"$1.off"
    run check --json "$1.off"; exits 3; prints_line "\"kind\": \"$1\""
    run check "$1.off"; exits 3; prints_line "^$1\.off: no embedding"
    run info "$1.off"; holds "info copes with $1" test $code == 0 -o $code == 3
    printf '0.3 0.3\n' >one.xyz
    run locate "$1.off" one.xyz -o "$1.csv"; refused 3 "$1\.off"; says '; --any locates'; absent "$1.csv"
}
defect repeated-vertex 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 1'
defect edge-shared 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n1 1 0\n3 0 1 2\n3 1 0 3\n3 0 1 4'
defect folded 'OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 0 1 3'
defect vertex-in-edge 'OFF\n6 2 0\n0 0 0\n2 0 0\n0 2 0\n1 0 0\n0 -1 0\n2 -1 0\n3 0 1 2\n3 3 4 5'
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 2 3\n3 0 1 2\n' >flat.off
run check flat.off; exits 0; prints_line '^triangle 1: '; prints_line 'an embedding.*; 1 flat triangle$'

# Many defects are all printed.
awk 'BEGIN { n = 3000; print "OFF"; print 3 * n, n, 0
    for (i = 0; i < n; i++) print "0 0 0\n1 0 0\n0 1 0"; for (i = 0; i < n; i++) print 3, 3*i, 3*i+1, 3*i+2 }' >same.off
run check same.off; exits 3; holds "there is a line for each" test "$(grep -c '^triangle ' "$logs/out")" -ge 2999
finish
