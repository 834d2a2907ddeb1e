#!/usr/bin/env bash
# walk: one walk listed, on meshes small enough to know it by hand; pictures; what is refused.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=step,triangle,iteration
list() { # list TRIANGLES...: a walk through these
    local i=0
    echo "$header"
    for t in "$@"; do
        echo "$i,$t,0"
        i=$((i + 1))
    done
}
triangles() { tail -n +2 "$logs/out" | cut -d, -f2 | xargs; }

# A row of four squares: triangles 0 to 7 from left to right.
awk 'BEGIN { print "OFF\n10 8 0"; for (x = 0; x < 5; x++) print x " 0 0\n" x " 1 0"
    for (x = 0; x < 4; x++) printf "3 %d %d %d\n3 %d %d %d\n",
    2*x, 2*x+2, 2*x+1, 2*x+2, 2*x+3, 2*x+1 }' >row.off
run walk --from 0.1,0.2 --to 3.9,0.8 --walk remembering row.off; exits 0; says_nothing
prints "$(list 0 1 2 3 4 5 6 7)"
run walk --from 3.9,0.8 --to 0.1,0.2 --walk=remembering row.off; exits 0
prints "$(list 7 6 5 4 3 2 1 0)"
run walk --from=1.6,0.1 --to 2.9,0.9 --walk lawson row.off; exits 0; prints "$(list 2 3 4 5)"
run walk --from 1.1,0.1 --to 1.1,0.2 row.off; exits 0; prints "$(list 2)"
run_on "$(<row.off)" walk --from 1.1,0.1 --to 1.9,0.9 --walk lawson -; exits 0; prints "$(list 2 3)"
run walk --from 1.1,0.1 --to 1.9,0.9 --walk lawson row.off -o row.csv; exits 0; prints ''
holds "the file holds the list" test "$(<row.csv)" == "$(list 2 3)"
run walk --help all
walks=$(sed -nE '/ --walk NAME/,/^ {0,6}-/p' "$logs/out" | sed -nE 's/^ {26}.([a-z-]+). .*/\1/p')
holds "there are walks" test "$(wc -w <<<"$walks")" -ge 15
for walk in $walks; do
    [[ $walk == all ]] && continue # pictures
    run walk --from 0.1,0.2 --to 3.9,0.8 --walk "$walk" row.off; exits 0; says_nothing
    prints_line '^0,0,0$'; prints_line '^[0-9]+,7,0$'
    holds "$walk: the last line is the last triangle" test \
        "$(tail -n 1 "$logs/out" | cut -d, -f2)" == 7
done

# Outside: on the far side of the hull; in the hole of a ring, where the triangles that fill it are
# not listed.
run walk --from 3.9,0.8 --to -5,0.5 --walk remembering row.off; exits 0
prints "$(list 7 6 5 4 3 2 1 0)"
says '^meshwalk: row\.off: --to lies outside the mesh$'
run walk --from -5,0.5 --to 1.1,0.1 --walk remembering row.off; exits 0; prints "$(list 0 1 2)"
says '^meshwalk: row\.off: --from lies outside the mesh: the walk begins where one to it ends$'
run walk -q --from -5,0.5 --to 9,0.1 --walk remembering row.off; exits 0; says_nothing
printf '%s\n' "$ring" >ring.off
run walk --from 0.5,1.4 --to 2.5,1.6 --walk remembering ring.off; exits 0; says_nothing
holds "the hole is crossed: $(triangles)" test "$(triangles)" == '6 1 3 2'
run walk --from 0.5,1.4 --to 2.5,1.6 --walk border ring.off; exits 0; says_nothing
holds "the hole is gone round: $(triangles)" test "$(triangles | wc -w)" -ge 5
run walk --from 1.5,1.5 --to 0.5,0.1 ring.off; exits 0; says -- '--from lies in a hole: '
run walk --from 0.5,0.1 --to 1.4,1.5 ring.off; exits 0; says -- '--to lies in a hole$'

# An octahedron, once as it is, once as longitudes and latitudes: facets 0 to 3 above, 4 to 7 below.
printf '%s\n' OFF '6 8 0' '1 0 0' '0 1 0' '-1 0 0' '0 -1 0' '0 0 1' '0 0 -1' \
    '3 0 1 4' '3 1 2 4' '3 2 3 4' '3 3 0 4' '3 1 0 5' '3 2 1 5' '3 3 2 5' '3 0 3 5' >octahedron.off
for walk in auto stochastic forgetful barycentric straight orthogonal; do
    run walk --as star --from 1,1,1 --to 1,1.1,-1 --walk $walk octahedron.off; exits 0; says_nothing
    holds "$walk begins and ends where it should: $(triangles)" grep -Eqx '0( [0-7])* 4' \
        <<<"$(triangles)"
    run walk --as star --lonlat --from 45,30 --to -135,-30 --walk $walk octahedron.off; exits 0
    holds "$walk begins and ends where it should: $(triangles)" grep -Eqx '0( [0-7])* 6' \
        <<<"$(triangles)"
done
run walk --as star --from 1,1,1 --to 1,1.1,-1 --walk stochastic octahedron.off; prints "$(list 0 4)"
awk 'NR > 2 && NR < 9 { $3 += 10 } { print }' octahedron.off >raised.off
run walk --as star --centre 0,0,10 --from 1,1,11 --to 1,1.1,9 --walk stochastic raised.off; exits 0
prints "$(list 0 4)"
run walk --as star --from 1,1,11 --to 1,1.1,9 raised.off; refused 3 'raised.off: '
says 'check --as star raised.off'

# A probe that goes into the octahedron from above: it ends in the facet that it touches, and begins
# with one that the motion points at.
for seed in 1 2 3 4 5; do
    run walk --as surface --seed $seed --from 0.1,0.2,5 --to 0.1,0.2,4 octahedron.off; exits 0
    says_nothing
    holds "the probe ends in facet 0: $(triangles)" grep -Eqx '([0-3] )*0' <<<"$(triangles)"
done
run walk --as surface --iterations 3 --from 7,7,5 --to 7,7,4 octahedron.off; exits 0
says '^meshwalk: octahedron.off: the probe touched nothing'
prints_line ',[0-7],2$'
run walk --as surface --max-distance 1 --iterations 1 --from 0.1,0.2,5 --to 0.1,0.2,4 octahedron.off
exits 0
says 'touched nothing'
run walk --as surface --max-distance 0 --from 0.5,0.25,5 --to 0.5,0.25,4 octahedron.off; exits 0
says 'touched nothing'
run walk --as surface --max-distance 0 --from 0.5,0.25,0.25 --to 0.5,0.25,0 octahedron.off; exits 0
says_nothing
run walk --as surface --from 1,2,3 --to 1,2,3 octahedron.off
refused 2 "'--to' must be another point than --from"

# What is refused, before anything is read.
run walk row.off; refused 2 "'--from' is missing"
run walk --from 1,2 absent.off; refused 2 "'--to' is missing"
run walk --from 1,2,3 --to 1,2 absent.off; refused 2 "'--from' must be X,Y with --as plane"
run walk --as star --from 1,2,3 --to 1,2 absent.off; refused 2 "'--to' must be X,Y,Z"
run walk --as star --lonlat --from 1,2,3 --to 1,2 absent.off; refused 2 "'--from' must be LON,LAT"
run walk --as star --lonlat --from 1,91 --to 1,2 octahedron.off
refused 2 "'--from' must be a latitude"
run walk --as star --from 0,0,0 --to 1,2,3 octahedron.off
refused 2 "'--from' must be another point than the centre"
for value in '' x 1 '1,' 1,x 1,2,3,4 1,inf ' 1,2' '1;2'; do
    run walk --from "$value" --to 1,2 row.off
    refused 2 "'--from' must be coordinates X,Y or X,Y,Z, not"
done
run walk --from 1,2 --to 3,4 --walk lawsn row.off; refused 2 "did you mean 'lawson'\?"
run walk --from 1,2 --to 3,4 --walk all row.off
refused 2 '--walk all needs --as plane and a picture'
run walk --from 1,2 --to 3,4 --walk all row.off -o all.csv; refused 2 '--walk all needs'
run walk --as star --from 1,2,3 --to 3,4,5 --walk all row.off -o all.svg
refused 2 '--walk all needs'
run walk --as star --from 1,2,3 --to 3,4,5 --walk lawson row.off
refused 2 "no walk 'lawson' with --as star"
run walk --as surface --from 1,2,3 --to 3,4,5 --walk straight row.off
refused 2 "'--walk' needs --as"
for option in max-distance samples iterations; do
    run walk --from 1,2 --to 3,4 --$option 2 row.off; refused 2 "'--$option' needs --as surface"
done
run walk --from 1,2 --to 3,4 --max-distance 0 row.off
refused 2 "'--max-distance' needs --as surface"
run walk --from 1,2 --to 3,4 --centre 0,0,0 row.off; refused 2 "'--centre' needs --as star"
run walk --lonlat --from 1,2 --to 3,4 row.off; refused 2 "'--lonlat' needs --as star"
run walk --from 1,2 --to 3,4 absent.off; refused 3 'absent.off'
for name in walk.gif walk.txt walk; do
    run walk --from 0.1,0.2 --to 3.9,0.8 row.off -o $name
    refused 2 "$name: .*\.csv.*\.svg, \.png or \.pdf"
    absent $name
done
run walk --from 0.1,0.2 --to 3.9,0.8 row.off -o row.off; refused 2 'row.off'
printf '%s\n' "$overlap" >overlap.off
run walk --from 0.1,0.2 --to 3.9,0.8 overlap.off; refused 3 'overlap.off: '
says 'check overlap.off'

run walk --plane --from 0.1,0.2 --to 3.9,0.8 row.off -o plane.svg
refused 2 "'--plane' needs --as star or --as surface"
run walk --as star --plane --from 1,1,1 --to 1,1.1,-1 octahedron.off
refused 2 "'--plane' needs a picture"
run walk --as star --grid uniform --from 1,1,1 --to 1,1.1,-1 octahedron.off -o plane.svg
refused 2 "'--grid' needs --as star --plane"
run walk --as surface --plane --grid uniform --from 1,1,1 --to 1,1.1,-1 octahedron.off -o plane.svg
refused 2 "'--grid' needs --as star --plane"
run walk --as star --plane --cells 9 --from 1,1,1 --to 1,1.1,-1 octahedron.off -o plane.svg
refused 2 "'--cells' needs --grid"
run walk --as star --plane --to 1,1.1,-1 octahedron.off -o plane.svg
refused 2 "'--from' is missing"
absent plane.svg

# Pictures, where the program can draw.
run walk --from 0.1,0.2 --to 3.9,0.8 row.off -o row.svg
if grep -q 'without Cairo' "$logs/err"; then
    refused 2 'without Cairo'
    absent row.svg
    finish
fi
begins_with() { [[ $(head -c ${#2} "$1" | tr -d '\0') == "$2" ]]; }
pictures() { # pictures NAME ARGUMENTS...: all three kinds
    local name=$1
    shift
    for ending in svg png pdf SVG; do
        run walk "$@" -o "$name.$ending"; exits 0; prints ''
    done
    holds "$name.svg is SVG" grep -q '<svg ' "$name.svg"
    holds "$name.SVG is the same" test "$(wc -c <"$name.svg")" == "$(wc -c <"$name.SVG")"
    holds "$name.png is PNG" test "$(head -c 4 "$name.png" | tail -c 3)" == PNG
    holds "$name.pdf is PDF" begins_with "$name.pdf" %PDF-
}
fills() { grep -Eo 'fill="rgb\([^"]*"|fill:rgb\([^;]*;|fill-rule:[^;]*;fill:rgb\([^;]*' "$1" |
    grep -o 'rgb(.*' | sort -u | wc -l; }
pictures row --from 0.1,0.2 --to 3.9,0.8 --walk remembering row.off
holds "each of the eight triangles has a colour of its own" test "$(fills row.svg)" -ge 8
pictures ring --from 0.5,1.4 --to 2.5,1.6 --walk border ring.off
pictures star --as star --lonlat --from 45,30 --to -135,-30 octahedron.off
pictures probe --as surface --from 0.1,0.2,5 --to 0.1,0.2,4 octahedron.off
run walk --from 9,9 --to 1e300,1e308 row.off -o far.svg; exits 0; says 'lies outside'
run walk --from 0.1,0.2 --to 3.9,0.8 row.off -o absent/row.svg; exits 4; says 'absent/row.svg'
# Where everything is on the page, and in which colour: picture_check.py knows it from the walk.
looks_right() { # looks_right VIEW MESH FROM TO ARGUMENTS...
    local view=$1 mesh=$2 from=$3 to=$4
    shift 4
    run walk --as "$view" --from "$from" --to "$to" "$@" "$mesh" -q -o look.csv; exits 0
    run walk --as "$view" --from "$from" --to "$to" "$@" "$mesh" -q -o look.svg; exits 0
    holds "the picture is right ($view $mesh)" \
        python3 "$here/picture_check.py" look.svg "$mesh" look.csv "$view" "$from" "$to"
}
run star octahedron.off --remesh 2 -o ball.off; exits 0
awk 'BEGIN { n = 12; print "OFF\n" n * n, 2 * (n - 1) * (n - 1), 0
    for (y = 0; y < n; y++) for (x = 0; x < n; x++) print x, y, 0
    for (y = 0; y < n - 1; y++) for (x = 0; x < n - 1; x++) { a = y * n + x
        print 3, a, a + 1, a + n + 1 "\n" 3, a, a + n + 1, a + n } }' >grid.off
looks_right plane row.off 0.1,0.2 3.9,0.8 --walk remembering
looks_right plane grid.off 1.1,1.2 2.9,2.8 --walk remembering
looks_right plane grid.off 1.1,1.2 8.9,7.8 --walk remembering
sed 's/^\([0-9.]*\) \([0-9.]*\) 0$/\1 \2 0/; s/^\([0-9]*\) \(11\) 0$/\1 200 0/' grid.off >tall.off
looks_right plane tall.off 1.1,1.2 8.9,7.8 --walk remembering
looks_right star octahedron.off 1,1,1 0.3,1.1,-1 --walk stochastic
looks_right star ball.off 1,1,1 0.3,1.1,-0.2 --walk stochastic
looks_right surface octahedron.off 0.1,0.2,5 0.1,0.2,4
looks_right surface ball.off 0.1,0.2,5 0.1,0.2,4
looks_right surface ball.off 0.3,0.2,0 0.3,0.25,-0.1
# All walks on one sheet: a caption each. In a list, or in space, they have no place.
run walk --from 0.1,0.2 --to 3.9,0.8 --walk all row.off -o all.svg; exits 0; says_nothing
run walk --from 0.1,0.2 --to 3.9,0.8 --walk straight row.off -o straight.svg; exits 0
holds "all walks take more room than one" test "$(wc -c <all.svg)" -gt \
    $((4 * $(wc -c <straight.svg)))
holds "the stages of the straight walk have colours" test "$(fills straight.svg)" -ge 8
run walk --from 0.1,0.2 --to 3.9,9 --walk all row.off -o all.png; exits 0
holds "what is outside is said once" test "$(grep -c outside "$logs/err")" == 1
# Step by step: a chunk fcTL for each triangle, numbers that count up, checksums that are right; the
# list with -o only.
# chunks FILE: the types of its chunks, with the number of those that have one; fails where a
# checksum is wrong
chunks() {
    python3 - "$1" <<'EOF'
import struct, sys, zlib
data, at = open(sys.argv[1], "rb").read(), 8
assert data[:8] == b"\x89PNG\r\n\x1a\n"
frame = b""
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    body = data[at + 8:at + 8 + size]
    assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body)
    print(kind.decode(), struct.unpack(">I", body[:4])[0] if kind in (b"acTL", b"fcTL", b"fdAT") else "")
    if kind == b"IHDR": width, height = struct.unpack(">II", body[:8])
    if kind in (b"fcTL", b"IEND") and frame: assert len(zlib.decompress(frame)) == height * (4 * width + 1); frame = b""
    if kind == b"fcTL": assert struct.unpack(">IIII", body[4:20]) == (width, height, 0, 0)
    if kind == b"fcTL": print("shown", struct.unpack(">HH", body[20:24])[0])
    if kind == b"fdAT": frame += body[4:]
    at += 12 + size
EOF
}
run walk --from 0.1,0.2 --to 3.9,0.8 --walk remembering row.off --animate row.apng; exits 0
prints ''; says_nothing
holds "the chunks are right" chunks row.apng >row.chunks
holds "eight frames" test "$(grep -c fcTL row.chunks)" == 8
holds "the last one stays for two seconds" test "$(grep shown row.chunks | sort | uniq -c | xargs)" == \
    "1 shown 2000 7 shown 500"
holds "eight are announced" grep -qx 'acTL 8' row.chunks
holds "numbers count up" test "$(grep -E '^f' row.chunks | cut -d' ' -f2 | xargs)" == \
    "$(seq 0 $(($(grep -cE '^f' row.chunks) - 1)) | xargs)"
holds "the picture of those who show no frames comes first" test \
    "$(cut -d' ' -f1 row.chunks | uniq | head -4 | xargs)" == 'IHDR acTL IDAT fcTL'
run walk --from 0.1,0.2 --to 3.9,0.8 --walk remembering row.off --animate two.png -o two.csv
exits 0; prints ''
holds "the list is there, too" test "$(<two.csv)" == "$(list 0 1 2 3 4 5 6 7)"
run walk --as star --lonlat --from 45,30 --to -135,-30 octahedron.off --animate star.png; exits 0
holds "frames of a polyhedron" chunks star.png >star.chunks
run walk --from 9,9 --to 9,8 row.off --animate none.png; exits 0
run walk --from 1,2 --to 3,4 row.off --animate steps.gif
refused 2 "'--animate' must be a .png or .apng file"; absent steps.gif
run walk --from 0.1,0.2 --to 3.9,0.8 row.off --walk all --animate all.png -o all.svg; exits 0
holds "a race and a sheet" test -s all.svg
holds "the race has more than one picture" grep -qa acTL all.png
run walk --from 0.1,0.2 --to 3.9,0.8 row.off --walk all --animate race.png; exits 0; prints ''
run walk --from 0.1,0.2 --to 3.9,0.8 row.off --walk all --animate race.png -o list.csv
refused 2 'needs --as plane and a picture'
run walk --from 1,2 --to 3,4 row.off --animate same.png -o same.png
refused 2 "'--animate' must be another file"
run walk --from 1,2 --to 3,4 row.off --animate absent/a.png; exits 4; says 'absent/a.png'
# Of a mesh with 80,000 triangles, lines near the walk.
awk 'BEGIN { srand(1); for (i = 0; i < 40000; i++) print rand(), rand() }' >points.xyz
run triangulate -q points.xyz -o large.ply; exits 0
run walk --from 0.01,0.01 --to 0.99,0.99 large.ply -o large.svg; exits 0; says_nothing
holds "the picture is not too large" test "$(wc -c <large.svg)" -lt 20000000
run walk --from 0.5,0.5 --to 0.52,0.52 large.ply -o small.svg; exits 0
holds "a short walk needs few lines" test "$(wc -c <small.svg)" -lt 2000000
# In the plane: of longitude and polar angle, with grids, whose first facets are yellow; of a probe.
has_yellow() { grep -Eq 'rgb\(94[0-9.]*%, ?89' "$1"; }
for walk in orthogonal straight auto; do
    run walk --as star --plane --lonlat --walk $walk --from 40,-20 --to 80,30 ball.off \
        -o plane.svg
    exits 0; says_nothing
    holds "$walk: a picture" grep -q '<svg ' plane.svg
done
holds "without a grid nothing is yellow" test -z "$(has_yellow plane.svg && echo yes)"
for grid in uniform nonuniform; do
    run walk --as star --plane --lonlat --grid $grid --cells 8 --to 80,30 ball.off -o $grid.svg
    exits 0; says_nothing
    holds "$grid: cells are yellow" has_yellow $grid.svg
done
run walk --as surface --plane --from 0.1,0.2,5 --to 0.1,0.2,4 octahedron.off -o probe.svg
exits 0; says_nothing
holds "the plane is dashed" grep -q 'stroke-dasharray' probe.svg
run walk --as surface --plane --iterations 3 --from 7,7,5 --to 7,7,4 octahedron.off \
    --animate plane.png
exits 0
says 'touched nothing'
holds "an animation" test -s plane.png

finish
