#!/usr/bin/env bash
# Damaged and odd meshes: exit code 3, a message with the file, and no file left; or a right answer.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '0.2 0.2\n' >q.xyz

# bad NAME PATTERN TEXT: a mesh that no command takes.
bad() {
    printf '%b' "$3" >"$1"
    run info "$1"; refused 3 "$2"
    run check "$1" -o report.txt; refused 3 "$2"; absent report.txt
    run locate "$1" q.xyz -o out.csv; refused 3 "$2"; absent out.csv
    run sample "$1" q.xyz -o out.csv; refused 3 "$2"; absent out.csv
    rm -f "$1"
    only_files q.xyz
}
bad index.off 'index\.off:6: ' 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 4294967296\n'
bad negative.off 'negative\.off:6: ' 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n'
bad huge.off 'huge\.off' 'OFF\n353535235358 6 0\n0 0 0\n'
bad faces.off 'faces\.off' 'OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n'
bad cut.off 'cut\.off' 'OFF\n3 1 0\n0 0 0\n1 0 0\n'
bad word.off 'word\.off:4: ' 'OFF\n3 1 0\n0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n'
bad comma.off 'comma\.off:4: ' 'OFF\n3 1 0\n0 0 0\n0,5 0 0\n0 1 0\n3 0 1 2\n'
bad empty.off 'empty\.off' ''
bad empty.ply 'empty\.ply' ''
bad header.ply 'header\.ply' 'ply\nformat ascii 1.0\nelement vertex 3\n'
bad face.obj 'face\.obj:4: ' 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n'
bad zipped.off.gz 'zipped' '\x1f\x8b\x08\x00broken'
bad prose.txt 'prose\.txt' 'This is no mesh.\nIt is prose.\n'
bad cloud.laz 'cloud\.laz' 'LASF\x00\x00\x00\x00'

# LAZ: a LAS header whose point format has the compression bit.
{ printf 'LASF'; head -c 20 /dev/zero; printf '\1\2'; head -c 68 /dev/zero
printf '\343\0\343\0\0\0\0\0\0\0\200\24\0'
  head -c 122 /dev/zero; } >cloud.laz
run triangulate cloud.laz -o out.ply; refused 3 'cloud\.laz.*(laszip|las2las|pdal|unpack)'
absent out.ply
run locate cloud.laz q.xyz; exits 3
rm cloud.laz

run info missing.off; refused 3 'missing\.off: .*No such file'
run info .; refused 3 'directory'
run locate . q.xyz; refused 3 'directory'
run triangulate . -o out.ply; refused 3 'directory'; absent out.ply
touch secret.off; chmod 000 secret.off
[[ -r secret.off ]] || { run info secret.off; refused 3 'secret\.off: .*Permission'; }
rm -f secret.off
only_files q.xyz

# No triangles: described, and checked, but no point can be located.
printf 'OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n' >none.off
run info none.off; exits 0; prints_line '^triangles +0$'
run info --json none.off; exits 0; holds "it is JSON" is_json "$logs/out"
printf 'OFF\n0 0 0\n' >void.off
run info void.off; exits 0; prints_line '^heights +no$'; prints_line '^low +none$'
holds "no number is printed that is none" test -z "$(grep -w nan "$logs/out")"
run info --json void.off; exits 0; holds "it is JSON" is_json "$logs/out"; prints_line '"low": null'
# Flat triangles only.
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n' >line.off
run info line.off; exits 0; prints_line '^flat triangles +1$'
# All vertices equal.
printf 'OFF\n3 1 0\n1 1 0\n1 1 0\n1 1 0\n3 0 1 2\n' >equal.off
# What check says is what locate does; --any is proposed only where it helps.
for mesh in none void line equal; do
    run check $mesh.off; exits 3; says_nothing
    prints_line "^$mesh\.off: no triangle with an area: nothing to locate in"
    run check --json $mesh.off; exits 3; holds "it is JSON" is_json "$logs/out"
    prints_line '"verdict": "no triangle with an area'
    for any in '' --any; do
        # shellcheck disable=SC2086 # no word or one
        run locate $any $mesh.off q.xyz -o out.csv; refused 3 "$mesh\.off: .*no triangle"
        absent out.csv
        holds "--any is not proposed" test -z "$(grep -e --any "$logs/err")"
    done
done
run check line.off; prints_line '; 1 flat triangle$'
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n' >nan.off
run check nan.off; exits 3; prints_line 'no embedding: 1 defect'
run locate nan.off q.xyz; refused 3 'nan\.off: '
holds "--any is not proposed" test -z "$(grep -e --any "$logs/err")"
rm -f ./*.off
only_files q.xyz

# One triangle, in odd clothes: clockwise, negative zero, CRLF, BOM, comments, huge and tiny
# coordinates.
one() {
    printf '%b' "$2" >"$1"
    run locate "$1" q.xyz; exits 0; prints_line '^0.2,0.2,inside,0,'
    run check "$1"; exits 0
    rm "$1"
}
one clockwise.off 'OFF\n3 1 0\n0 0 0\n0 1 0\n1 0 0\n3 0 1 2\n'
one minus.off 'OFF\n3 1 0\n-0.0 -0 0\n1 -0.0 0\n-0 1 0\n3 0 1 2\n'
one crlf.off 'OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n'
one bom.obj '\xef\xbb\xbf# a comment\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n'
one comment.off '# before\nOFF # here\n3 1 0\n\n0 0 0 # there\n1 0 0\n0 1 0\n3 0 1 2\n'
one large.off 'OFF\n3 1 0\n-1e100 -1e100 0\n1e100 -1e100 0\n0 1e100 0\n3 0 1 2\n'
only_files q.xyz
finish
