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

# repeats NAME PLACE TEXT: the second face has a vertex twice, and the place is told.
repeats() {
    printf '%b' "$3" >"$1"
    run info "$1"; exits 0
    run locate "$1" q.xyz -o out.csv; refused 3 "$1: triangle 1: vertex 2 is in it twice"
    absent out.csv
    says "^meshwalk: $1$2 has vertex [23] twice"
    rm "$1"
}
vertices='1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n'
repeats a.14 ':8: face 2' "bad\n2 4\n$vertices"'1 3 1 2 3\n2 3 1 3 3\n0\n0\n0\n0\n'
repeats a.gr3 ':8: face 2' "bad\n2 4\n$vertices"'1 3 1 2 3\n2 3 1 3 3\n'
nodes='ND 1 0 0 1\nND 2 1 0 1\nND 3 1 1 1\nND 4 0 1 1\n'
repeats a.2dm ':7: face 2' "MESH2D\n$nodes"'E3T 1 1 2 3 1\nE3T 2 1 3 3 1\n'
nodes='NPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1 3\n'
repeats a.su2 ':4: face 1' 'NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 2 1\n'"$nodes"
repeats a.off ':8: face 1' 'OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 2\n'
repeats a.obj ':6: face 2' 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 3\n'

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

# netCDF-4 in which one count and one address are changed: HDF5 1.10 follows them out of its memory.
base64 -d <<'END' | gunzip >damaged.nc
H4sIAAAAAAACA+1aXWwUVRS+M7O73bbTX1bKn2EKFSPU2pbaALHSZn9otd3WbtWI6DLsTu2Q7UzZHZqWmIBoUIwGY3yRxMiD8UET
4w9PYnwgPpgIBENigryYmBgjKG2iwZggzr3n3p2f7kiLLcFkTrvdnTv3nnvP+b5z79kzPdobS1RVrKrgw2HE5AaVK01w3UrbO1Zf
rxzsjQ3z4kl+HWkRwq4hbqngEYfv19biv9sF6D3EZqpEThHbiFYkojAKIBTVtUlFM1RdK6BlWIv54s1XNHF/W8sW6fEdw30x81Nr
SMLDuABTUzWuFMbas2ktqWeVwlXaev6yup4sv2oLx0VwC89xxUHsXYjgFdc1rqUtEmoIo4aD5qcgsUWowLYE0On10P9TOu6uNWSA
EPL0hbgJjAtR4/p7UimHWbG+gXgy1TeYTKeiPf1xJO40jTIHBGFAsmcgTvp30/4jY2pBMn9lSVOMaCwhZdVxRSuY7pL27DckTTes
W5NyXpX35JQWiUkHwgviTf3Vpr9N/emkYmSyox0xdVzNotowKnqALwI09dLFbeBDZPMhu88vyIcINQOL0JsuHwYWz4cw0TFKvDHG
s4VYTghcjeZI5OwP5YPR3kdhCiEIrU+x2yGrJ+Mn5+ZnQs4ohc3UbS+PHD6L9S0t7O3ol293PzwXQ4Fht0AMv7xdGO4K/gcMeQ8M
E9EfH7AwPE8x6yuF4X2AIeP4cobhgDyVHjVxTGt4s7lG/de488QLSw/mZlT/7KoPimAGWBAKIobI7gQKWihcT5zPMTACLtjKvGHb
CLCFwZLMaDqv5xRiTBWdFrskbegTek5/blrsBsuXmfiYLGPN6aKBTpBMCrLw4GzbCQCzsgxaHmG3alEJOff18n7sc2YL72kLaNXL
YdwAcnH/xCuduwl4PUCxOjAZA5zO6Ho+q2qyocCZtNpmO6YD7jMl2a+m8akmmD81NjWWF9wOLJ5bYhd2j4AaYFiRY+YSNE3JGOqk
akyT4XXO4RYb8cxBa2Zy499nJjuSGMPUF9BKGDbuYLhLwXKXAmc4zJzZsGbuXuNx5krbEeQT3aijEnXcEIp7TQgA+4ICprlIG/Qm
bQ/gGgESsk0iagPxZiwke8024HI1OKRgyFpWzpvWyuMQAQ3UCxN5fS+GRtfSUzaqECU/fXL8D2uv6az0IB87LALuw4IwK0MzrrYP
f++xlEVoPOTZeiUgLt11sAayzJADLHEd8LIceuX0jGwwWAO0J54VoY0fXftm8WB8sfJ/BOO0G8bDsyM2z18XQfVjXjAGS8E4vbEC
Wt8+Hm+2lK1oXFoYL909dqEII0nued7K3gR3Fsfeb3qYnKRfFFbMPweILxhQd5LJOU6IZBW0HmIHBGk9IsHVXoZOsMiF1NOnPrM8
/321VzQ2AYwsE6ibs8fOUjb/dSXyDDk0NgPJSpyTbK8svZWLWwFtEXxisjNvpFUtq0zNi9xr1aOvL16MDq13UnEe+cHixChMf28N
XP26oEgoovZuZ3vEAvdVV1jNidGyUjF64Byl1JMb3vmOABsDYCtN87CBCTWXe0LO7VdKutPLPoT+PDjfiBUfggyAfh2+ldRjEyQA
njtemOqQc4Zq7M8q49eunMLGstA2aGhLDIh+WFKNmYJF7Kl6f19qxEwYIDVrYJpLOAG/H6m1Pp899t7PO6KD/Zwtr2N9WXnhqiv2
3e2Cq519pQp4tAed7RrL2kMe+pnsrkG++OKLL7744sudK5zvAl988cUXX3y5s4WUV3axpyTzrSyUqgiyykLAdY2/8T///qVVC1kR
q4G8taQ1ELz6A/KFAp4xtJLcDRQLVFDM+YrWK3DV1Fa/TiejQ3l9QskbKq0IraP6JpU8fkDT1d6skSpcV0fL1pbW5rHs6INdbS1t
rS1bMm98/PmtoOR+fsgqJWKOodeKfTIcT8SH48loHHzSyYNPsrIhFxTDco71LCl8s+LgrOufRYJNjfeUWpF421fErv+eOX3RvqIz
JXgTWjTe4FrVb/v2rS3lA/Z4VHyNPf9bLB+4/00gE3aiwh5sMGFFVCb1qUOXnS0z253vXuLsx9ninretZ25/8qgdG9b9D12Cwxrs
JAAA
END
if ! "$meshwalk" --version | grep -q 'libnetcdf is not found'; then
    run info damaged.nc; refused 3 'damaged.nc: '
    run sample damaged.nc q.xyz -o out.csv; refused 3 'damaged.nc: '; absent out.csv
    run sample damaged.nc q.xyz --time all -o out.nc; refused 3 'damaged.nc: '; absent out.nc
    run convert damaged.nc out.off; refused 3 'damaged.nc: '; absent out.off
fi
rm -f damaged.nc
finish
