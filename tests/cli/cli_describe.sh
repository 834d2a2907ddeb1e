#!/usr/bin/env bash
# info and check: facts, defects with their places, exit codes, JSON.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >square.off
printf '%s\n' "$ring" >ring.off
printf '%s\n' "$overlap" >overlap.off

run info square.off; exits 0; says_nothing
for fact in 'vertices +4' 'unused vertices +0' 'triangles +2' 'flat triangles +0' \
    'clockwise triangles +0' \
    'oriented +yes' 'clashing edges +0' 'border edges +4' 'border loops +1' 'components +1' \
    'holes +0' 'low +0 0' \
    'high +1 1' 'area +1' 'embedding +yes' 'convex +yes' 'delaunay +yes' 'heights +yes' \
    'height range +0 2' \
    'fields +none' 'memory bytes +[1-9][0-9]*'; do
    prints_line "^$fact\$"
done
run info ring.off; exits 0
for fact in 'border edges +8' 'border loops +2' 'holes +1' 'area +8' 'convex +no' \
    'embedding +yes'; do
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
cp square.off 'é-€-𝄞.off'
run info --json 'é-€-𝄞.off'; exits 0; prints_line '"é-€-𝄞.off"'

run check square.off; exits 0; prints 'square.off: an embedding: every promise holds'; says_nothing
run check overlap.off; exits 3; says_nothing
prints_line '^triangle [01]: '; prints_line '^overlap\.off: no embedding: [1-9][0-9]* defects?'
run check --json overlap.off; exits 3; prints_line '"kind": "crossing"'
prints_line '"embedding": false'

# One defect of each kind that can be told apart.
defect() { # defect KIND OFF-TEXT
    printf '%b\n' "$2" >"$1.off"
    run check --json "$1.off"; exits 3; prints_line "\"kind\": \"$1\""
    run check "$1.off"; exits 3; prints_line "^$1\.off: no embedding"
    run info "$1.off"; holds "info copes with $1" test $code == 0 -o $code == 3
    printf '0.3 0.3\n' >one.xyz
    run locate "$1.off" one.xyz -o "$1.csv"; refused 3 "$1\.off"; says '; --any locates'
    absent "$1.csv"
}
defect repeated-vertex 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 1'
defect edge-shared 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n1 1 0\n3 0 1 2\n3 1 0 3\n3 0 1 4'
defect folded 'OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 0 1 3'
defect vertex-in-edge 'OFF\n6 2 0\n0 0 0\n2 0 0\n0 2 0\n1 0 0\n0 -1 0\n2 -1 0\n3 0 1 2\n3 3 4 5'
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n3 0 2 3\n3 0 1 2\n' >flat.off
run check flat.off; exits 0; prints_line '^triangle 1: '
prints_line 'an embedding.*; 1 flat triangle$'


# As a surface, and as a star-shaped polyhedron: an octahedron with the fronts out, and what is
# wrong with others.
cat >octahedron.off <<'END'
OFF
6 8 0
1 0 0
0 1 0
-1 0 0
0 -1 0
0 0 1
0 0 -1
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
3 1 0 5
3 2 1 5
3 3 2 5
3 0 3 5
END
run info --as surface octahedron.off; exits 0; says_nothing
for fact in 'vertices +6' 'unused vertices +0' 'triangles +8' 'flat triangles +0' 'oriented +yes' \
    'clashing edges +0' \
    'closed +yes' 'border edges +0' 'border loops +0' 'pinched vertices +0' 'components +1' \
    'euler +2' 'low +-1 -1 -1' \
    'high +1 1 1' 'area +6\.92820323027[0-9]*' 'volume +1\.33333333333333[0-9]*' \
    'memory bytes +[1-9][0-9]*'; do
    prints_line "^$fact\$"
done
holds "a surface has no heights, and is no embedding" test -z \
    "$(grep -E '^(height|embedding|holes|delaunay)' "$logs/out")"
run info --as star octahedron.off; exits 0
for fact in 'closed +yes' 'centre +0 0 0' 'star shaped +yes' 'why not +-'; do
    prints_line "^$fact\$"
done
run info --as star --centre 2,0,.5 --json octahedron.off; exits 0
holds "it is JSON" is_json "$logs/out"
prints_line '"centre": \[2, 0, 0\.5\]'; prints_line '"star_shaped": false'
prints_line '"why_not": "triangle [0-7]: '
run info --as star --json octahedron.off; exits 0; holds "it is JSON" is_json "$logs/out"
prints_line '"why_not": null'
run info --as surface --json square.off; exits 0; holds "it is JSON" is_json "$logs/out"
prints_line '"volume": null'; prints_line '"closed": false'; prints_line '"border_edges": 4'
prints_line '"high": \[1, 1, 2\]'
run info octahedron.off; exits 0; prints_line '^embedding +no$'; prints_line '^heights +yes$'

run check --as surface octahedron.off; exits 0
prints 'octahedron.off: a sound surface: every promise holds'
run check --as star octahedron.off; exits 0
prints 'octahedron.off: star-shaped about the centre: every promise holds'; says_nothing
run check --as star --json octahedron.off; exits 0; holds "it is JSON" is_json "$logs/out"
prints_line '"star_shaped": true'; prints_line '"defects": \[\]'
run check --as surface --json octahedron.off; exits 0; holds "it is JSON" is_json "$logs/out"
prints_line '"surface": true'
run check --as star --centre 1,0,0 octahedron.off; exits 3
prints_line '^triangle 0: .*the centre'
prints_line '^octahedron\.off: not star-shaped about the centre: [0-9]+ defects'
run check octahedron.off; exits 3; prints_line 'no embedding'
run check --as surface square.off; exits 0
prints 'square.off: a sound surface: every promise holds'
defect_as() { # defect_as KIND AS FILE: listed, with its name and its verdict
    run check --as "$2" --json "$3"; exits 3; prints_line "\"kind\": \"$1\""
    holds "it is JSON" is_json "$logs/out"
    run check --as "$2" "$3"; exits 3
    prints_line "^$3: (no sound surface|not star-shaped about the centre): [0-9]+ defects?"
}
sed 's/^3 0 1 4$/3 1 0 4/' octahedron.off >clashing.off
defect_as clashing surface clashing.off
run check --as star clashing.off; exits 0
sed 's/^6 8 0/6 7 0/; $d' octahedron.off >open.off
defect_as open-edge star open.off
run check --as surface open.off; exits 0
sed 's/^0 0 1$/3 3 0/' octahedron.off >through.off
defect_as through-centre star through.off
sed 's/^0 0 1$/0 0 -3/' octahedron.off >turned.off
defect_as turned star turned.off
run info --as star turned.off; exits 0; prints_line '^star shaped +no$'
prints_line '^why not +triangle [0-7]: '
{ sed -n 's/^6 8 0/12 16 0/; 1,8p' octahedron.off; sed -n '3,8p' octahedron.off
sed -n '9,$p' octahedron.off
    sed -n '9,$p' octahedron.off | awk '{ print 3, $2 + 6, $3 + 6, $4 + 6 }'; } >twice.off
sed '9,14s/1/2/' twice.off >covered.off
defect_as covered star covered.off
defect_as edge-shared star twice.off
run check --as surface twice.off; exits 0
run check --as surface --weld twice.off; exits 3; prints_line '^triangle [0-9]+: .*share'
for mesh in repeated-vertex edge-shared; do defect_as $mesh surface $mesh.off; done
run check --as surface folded.off; exits 3; prints_line '^triangle [01]: .*oriented differently'
printf 'OFF\n3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n' >line.off
run check --as surface line.off; exits 3
prints_line '^line\.off: no triangle with an area: nothing to touch; 1 flat triangle$'

# Longitudes and latitudes without z: an octahedron, its poles and its seam each in several
# vertices.
printf '9 2 0 0\n0 -180 0\n1 -90 0\n2 0 0\n3 90 0\n4 180 0\n5 0 90\n6 10 90\n7 0 -90\n8 5 -90\n' \
    >globe.node
printf '8 3 0\n0 0 1 5\n1 1 2 5\n2 2 3 6\n3 3 4 6\n4 1 0 7\n5 2 1 7\n6 3 2 8\n7 4 3 8\n' >globe.ele
run check --as star --lonlat globe.node; exits 0
prints 'globe.node: star-shaped about the centre: every promise holds'
run info --as star --lonlat globe.node; exits 0
for fact in 'closed +yes' 'euler +2' 'star shaped +yes' 'low +-1 -1 -1' 'high +1 1 1'; do
    prints_line "^$fact\$"
done
run check --as star globe.node; exits 3
run info --as surface globe.node; exits 0; prints_line '^closed +no$'
prints_line '^low +-180 -90 0$'

# Many defects are all printed.
awk 'BEGIN { n = 3000; print "OFF"; print 3 * n, n, 0
    for (i = 0; i < n; i++) print "0 0 0\n1 0 0\n0 1 0";
    for (i = 0; i < n; i++) print 3, 3*i, 3*i+1, 3*i+2 }' >same.off
run check same.off; exits 3
holds "there is a line for each" test "$(grep -c '^triangle ' "$logs/out")" -ge 2999

# Names in JSON: characters of UTF-8 as they are, every other byte as U+FFFD.
cat >names.py <<'END'
import json, os, subprocess, sys
characters = [c.encode() for c in "a\u0080\u07ff\u0800\ud7ff\ue000\uffff\U00010000\U0010ffff\u0001\u001f \"\\\u007f"]
wrong = [b"\x80", b"\xbf", b"\xc0\xaf", b"\xc1\xbf", b"\xc2\xc3", b"\xe0\x9f\xbf", b"\xed\xa0\x80",
         b"\xf0\x8f\xbf\xbf", b"\xf4\x90\x80\x80", b"\xf5\x80\x80\x80", b"\xff", b"\xe2\x82", b"\xf0\x90\x80"]
for piece in characters + wrong:
    name = b"n" + piece + b"m.off"
    os.rename(b"given.off", name)
    out = subprocess.run([sys.argv[1], "info", "--json", name], capture_output=True, check=True).stdout
    told = json.loads(out.decode())["file"]
    want = name.decode() if piece in characters else "n" + "\ufffd" * len(piece) + "m.off"
    assert told == want, (piece, told, want)
    os.rename(name, b"given.off")
END
cp square.off given.off
holds "names are quoted" python3 names.py "$meshwalk"
finish
