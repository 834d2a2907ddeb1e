#!/usr/bin/env bash
# edit: lines carried out and answered in order, what is refused, and the files that tell what
# changed.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >m.off
printf '%s\n' "$ring" >ring.off

# --- lines ---
edits='# a point in triangle 0, which the new vertex 4 parts into three
locate 0.75 0.25
insert 0.75 0.25
locate,0.75,0.25
  move, 4, 0.75, 0.5 # nearer to the border

value 4 7
LOCATE 0.75 0.5
"locate","0.1","0.2",,
locate 2 2
locate nan 0
'
answers='x,y,status,triangle,w0,w1,w2
0.75,0.25,inside,0,0.25,0.5,0.25
0.75,0.25,vertex,0,0,0,1
0.75,0.5,vertex,0,0,0,1
0.1,0.2,inside,1,0.8,0.1,0.1
2,2,outside,-1,,,
nan,0,bad,-1,,,'
run_on "$edits" edit m.off - -o out.off; exits 0; says_nothing
prints_line '^0.75,0.5,vertex,'; prints_line '^2,2,outside,-1,,,$'; prints_line '^nan,0,bad,-1,,,$'
holds "there is a header and six answers" test "$(wc -l <"$logs/out")" == 7 -a \
    "$(head -n 1 "$logs/out")" == "${answers%%$'\n'*}"
run check out.off; exits 0; says_nothing
run info out.off; prints_line '^vertices +5$'; prints_line '^triangles +4$'
prints_line '^delaunay +yes$'
# Values: interpolated, given, kept by a move.
run_on $'0.75 0.5\n' sample out.off -; prints $'x,y,z\n0.75,0.5,7'
run_on $'insert 0.75 0.25\nmove 4 0.75 0.5\n' edit m.off - -o out.off; exits 0; prints ''
run_on $'0.75 0.5\n' sample out.off -; prints $'x,y,z\n0.75,0.5,1'
run_on $'insert 0.75 0.25 30\nlocate 0.75 0.25\nlocate 0 0\nlocate 9 9\n' edit m.off - -o out.off \
    --heights
exits 0; prints_line '^0.75,0.25,vertex,[0-9]+,[01],[01],[01],30$'; prints_line '^0,0,vertex,.*,0$'
prints_line '^9,9,outside,-1,,,,$'
# As a mesh of one's own: what locate says after an edit is what it says in the mesh written, where
# nothing is gone.
run_on $'insert .3 .2\nlocate .9 .1\nlocate .1 .9\nlocate .5 .5\n' edit m.off - -o out.off; exits 0
answer=$(<"$logs/out")
run_on $'0.9 0.1\n0.1 0.9\n0.5 0.5\n' locate out.off -; prints "$answer"
for way in '--walk straight' '--walk border' '--start grid' '--start two-level-grid --cells 9' \
    '--start layers --layers 2' \
    '--start curve' '--seed 7 --walk stochastic --start random' '--threads 1'; do
    # shellcheck disable=SC2086 # words
    run_on $'insert .3 .2\nlocate .9 .1\nlocate .1 .9\nlocate .5 .5\n' edit m.off - -o out.off $way
    exits 0; prints "$answer"
done
# Nothing to do is done, too: the mesh is written anew.
run_on '' edit m.off - -o out.off; exits 0; prints ''; says_nothing
run info out.off; prints_line '^vertices +4$'; prints_line '^heights +yes$'
run_on $'\n# nothing\n,,,\n' edit m.off - -o out.off; exits 0; prints ''
printf 'insert .5 .25\n' | gzip >e.gz
run edit m.off e.gz -o out.ply; exits 0
run info out.ply; prints_line '^vertices +5$'
rm out.ply e.gz

# --- what is refused: the line is named, and nothing is written ---
rm out.off
bad() { # bad EDITS LINE PATTERN: exit code 3; with --skip the rest is carried out
    run_on "$1" edit m.off - -o out.off; exits 3; says "^meshwalk: standard input:$2: $3"
    only_files m.off ring.off
    printf '%s' "$1" >e.txt
    run edit m.off e.txt -o out.off --skip; exits 0; says "^meshwalk: e\.txt:$2: $3"
    holds "the mesh is written" test -s out.off
    run edit m.off e.txt -o out.off --skip --quiet; exits 0; says_nothing
    run edit m.off e.txt -o out.off --skip --strict; exits 1
    rm out.off e.txt
}
bad $'insert .5 .25\ninsrt 1 2\n' 2 "unknown edit 'insrt'; known edits are insert, remove, move"
bad $'\n\ninsert 1\n' 3 'insert: the y is missing'
bad $'insert x 1\n' 1 "insert: x: 'x' is not a number"
bad $'insert nan 1\n' 1 'insert: .*not finite'
bad $'remove 4\n' 1 'remove: vertex 4 is not there'
bad $'insert .5 .25\nremove 4\nremove 4\n' 3 'remove: vertex 4 is not there'
bad $'flip 0 0\n' 1 'flip: '
bad $'insert .5 .25\nflip 1 3\n' 2 'flip: '
bad $'insert .5 .25\nconstrain 0 2\nconstrain 4 3\n' 3 'constrain: '
bad $'release 0 2\n' 1 'release: '
bad $'value 9 1\n' 1 'value: vertex 9 is not there'
bad $'value 0 1 salt\n' 1 "value: there is no field 'salt'"
bad $'undo\n' 1 'undo: there is no edit'
bad $'insert .5 .25\ncompact\nundo\n' 3 'undo: there is no edit'
run_on $'insert 1.5 1.5\n' edit ring.off - -o out.off; exits 3; says ':1: insert: '
run_on $'remove 0\n' edit ring.off - -o out.off; exits 3; says ':1: remove: '
run_on $'move 5 1.75 1.4\nlocate 1.5 1.5\n' edit ring.off - -o out.off; exits 0
prints_line '^1.5,1.5,hole,-1,,,$'
run check out.off; exits 0
run_on $'move 5 2.5 1.5\n' edit ring.off - -o out.off
exits 3; says ':1: move: vertex 5 cannot move there: triangle [0-9]+ would turn over or be flat'
run_on $'locate 1.5 1.5\n' edit ring.off - -o out.off --strict; exits 1
prints_line '^1.5,1.5,hole,-1,,,$'
rm out.off
run edit m.off absent.txt -o out.off; refused 3 'absent\.txt: No such file'; absent out.off
run edit absent.off m.off -o out.off; refused 3 'absent\.off: No such file'
run edit m.off ring.off -o out.off; refused 3 "ring\.off:1: unknown edit 'OFF'"
printf 'undo\n\0\n' >e.txt
run edit m.off e.txt --skip -o out.off; refused 3 'e\.txt:2: '; absent out.off
printf '%s\n' "$overlap" >bad.off
run edit bad.off e.txt -o out.off; refused 3 "bad\.off: "; says "'meshwalk check bad\.off' lists"
printf 'OFF\n4 2 0\n0 0 0\n2 0 0\n1 0 0\n1 1 0\n3 0 1 3\n3 0 2 1\n' >bad.off
run edit bad.off e.txt -o out.off; refused 3 'bad\.off: '
printf '3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n' >flat.node; printf '1 3 0\n0 0 1 2\n' >flat.ele
run_on $'insert .1 .1 5\n' edit flat.node - -o out.off; refused 3 ':1: insert: the mesh has no z'
run_on '' edit flat.node - -o out.off --heights; refused 3 'flat\.node: has no heights'
rm bad.off flat.* e.txt

# --- what changed ---
cat >e.txt <<'END'
insert .5 .25
locate .5 .25
insert .5 .25
move 4 .5 .375
flip 0 2
undo
value 4 8
remove 4
compact
END
run edit m.off e.txt -o out.off --delaunay never --answers a.csv --changes c.csv --log l.txt \
    --numbers n.csv
exits 0; prints ''; says_nothing
holds "the answers" test "$(cut -d, -f1-3 a.csv)" == $'x,y,status\n.5,.25,vertex' -o \
    "$(cut -d, -f1-3 a.csv)" == $'x,y,status\n0.5,0.25,vertex'
holds "the changes: $(<c.csv)" test "$(<c.csv)" == 'line,edit,vertex,vertex_is,made,reused,freed,flips,pieces
1,insert,4,made,2 3,0,,0,0
3,insert,4,,,,,0,0
4,move,4,,,,,0,0
5,flip,,,,'"$(sed -n '5s/^5,flip,,,,//p' c.csv)"'
6,undo,,,,'"$(sed -n '6s/^6,undo,,,,//p' c.csv)"'
7,value,4,,,,,0,0
8,remove,4,freed,,0,2 3,0,0
9,compact,,,,,,0,0'
holds "the log: $(<l.txt)" test "$(<l.txt)" == 'insert 0.5 0.25
insert 0.5 0.25
move 4 0.5 0.375
value 4 8
remove 4
compact'
holds "numbers of both" test "$(grep -c ',vertex,' n.csv)" == 9 -a "$(grep -c ',triangle,' n.csv)" \
    == 6
holds "what is gone is -1" test "$(grep -- ',-1$' n.csv | tr '\n' ' ')" == \
    '9,vertex,4,-1 9,triangle,2,-1 9,triangle,3,-1 '
holds "the header" test "$(head -n 1 n.csv)" == line,what,old,new
run_on '' edit m.off - -o out.off --answers a.csv --changes c.csv --log l.txt --numbers n.csv
exits 0
holds "files without lines have their headers" test "$(cat a.csv c.csv l.txt | wc -l)" == 2
rm a.csv c.csv l.txt n.csv

# The log of any session makes the same mesh, numbers included; undo reaches as far as it is told.
stream() { # stream SEED LINES: any edits, many of which are refused
    awk -v seed="$1" -v n="$2" 'BEGIN {
        srand(seed)
        for (i = 0; i < n; i++) {
            r = int(rand() * 16); v = int(rand() * (6 + i / 3)); w = int(rand() * (6 + i / 3))
            if (r < 6) print "insert", rand() * 3, rand() * 3
            else if (r < 8) print "remove", v
            else if (r < 10) print "move", v, rand() * 3, rand() * 3
            else if (r < 11) print "flip", v, w
            else if (r < 12) print "constrain", v, w
            else if (r < 13) print "release", v, w
            else if (r < 14) print "value", v, rand()
            else if (r < 15) print "undo"
            else if (rand() < 0.05) print "compact"
            else print "locate", rand() * 3, rand() * 3
        }
    }'
}
seed=0
for mesh in m.off ring.off; do
    for way in '' '--delaunay never' '--delaunay make --undo 1' '--undo 3'; do
        seed=$((seed + 1))
        stream $seed 1500 >e.txt
        # shellcheck disable=SC2086 # words
        run edit $mesh e.txt -o one.ply --skip -q --log l.txt --numbers n.csv $way; exits 0
        # shellcheck disable=SC2086
        run edit $mesh l.txt -o two.ply --numbers k.csv ${way/--undo [13]/}; exits 0; says_nothing
        holds "stream $seed on $mesh ($way): the log makes the same mesh" cmp one.ply two.ply
        holds "stream $seed on $mesh ($way): and the same numbers" test "$(grep '^,' n.csv)" == \
            "$(grep '^,' k.csv)"
        run check one.ply; exits 0
    done
done
run_on $'insert .5 .25\ninsert .25 .5\nundo\nundo\nundo\n' edit m.off - -o out.off; exits 3
says ':5: undo: '
run_on $'insert .5 .25\ninsert .25 .5\nundo\nundo\n' edit m.off - -o out.off --undo 1; exits 3
says ':4: undo: '
rm ./*.ply ./*.csv ./*.txt

# --- meshes ---
run_on $'insert .75 .25\nremove 4\n' edit m.off - -o back.off; exits 0
run_on $'remove 1\nlocate .9 .1\n' edit m.off - -o less.off; exits 0; prints_line '^0.9,0.1,outside'
run info less.off; prints_line '^vertices +3$'
run_on $'insert 2 .5 9\n' edit m.off - -o more.off; exits 0 # the hull grows
run check more.off; exits 0
run info more.off; prints_line '^convex +yes$'
# Fields, by their names and in any format that holds them.
printf '# attributes: z, wind speed\n4 2 2 0\n0 0 0 1 10\n1 1 0 2 20\n2 1 1 3 30\n3 0 1 2 20\n' \
    >f.node
printf '2 3 0\n0 0 1 2\n1 0 2 3\n' >f.ele
run_on $'insert .5 .5 7 "wind speed"\nvalue 0 -5 "wind speed"\n' edit f.node - -o g.ply --log l.txt
exits 0
run_on $'0.5 0.5\n0 0\n' sample --field wind_speed g.ply -; exits 0; prints_line '^0.5,0.5,7$'
prints_line '^0,0,-5$'
run_on $'0.5 0.5\n' sample g.ply -; prints_line '^0.5,0.5,2$'
run edit f.node l.txt -o h.ply; exits 0; holds "names of fields come back" cmp g.ply h.ply
for format in off obj stl node ply-ascii vtk csv; do
    run_on $'insert .5 .5\n' edit f.node - -o - --format $format
    if [[ $format == node ]]; then refused 2 'two files'; else exits 0; holds "$format is written" \
        test -s "$logs/out"; fi
done
# Edges along constraints stay; without them the mesh is not Delaunay.
cat >lines.geojson <<'END'
{"type": "GeometryCollection", "geometries": [
  {"type": "Polygon", "coordinates": [[[0, 0], [10, 0], [10, 4], [0, 4], [0, 0]]]},
  {"type": "LineString", "coordinates": [[1, 1], [9, 1]]}]}
END
printf '%s\n' x,y 5,1.25 5,.75 8.5,1 >points.csv
run triangulate points.csv --constraints lines.geojson --crs EPSG:4326 -q -o c.ply; exits 0
run info c.ply; prints_line '^delaunay +no$'
run_on $'insert 4 1.5\nremove 7\n' edit c.ply - -o d.ply --constraints lines.geojson; exits 3
says ':2: remove: '
run_on $'constrain 0 1\n' edit c.ply - -o d.ply --constraints lines.geojson; exits 3
says ':1: constrain: '
run_on $'insert 4 1.5\nlocate 3 1\n' edit c.ply - -o d.ply --constraints lines.geojson --stats \
    --json
exits 0; prints_line '^3,1,edge,'
holds "the statistics are JSON" is_json "$logs/err"
says '"delaunay": true'
run_on $'locate 3 1\n' edit c.ply - -o d.ply --stats; exits 0; prints_line '^3,1,edge,'
says '^delaunay +no$'
run_on $'locate 5 1\n' edit c.ply - -o d.ply --delaunay make --stats; exits 0
says '^delaunay +yes$'; says '^constraints +0$'
run info d.ply; prints_line '^delaunay +yes$'
run_on $'release 7 8\n' edit c.ply - -o d.ply --constraints lines.geojson; exits 0
run info d.ply; prints_line '^delaunay +yes$'
printf '{"type": "LineString", "coordinates": [[1, 1], [9, 4]]}' >other.geojson
run edit c.ply <(:) -o e.ply --constraints other.geojson
refused 3 'other\.geojson: feature 0: the vertex at 9 4 is not in c\.ply'
printf '{"type": "LineString", "coordinates": [[1, 1], [10, 4]]}' >other.geojson
run edit c.ply <(:) -o e.ply --constraints other.geojson
refused 3 'the edge from 1 1 is not in c\.ply'; absent e.ply
run edit c.ply <(:) -o e.ply --constraints absent.geojson; refused 3 'absent\.geojson: '
rm -f ./*.ply ./*.geojson points.csv l.txt f.* g.* back.off less.off more.off out.off
only_files m.off ring.off

# --- outputs ---
printf 'insert .5 .25\nlocate .5 .5\n' >e.txt
run edit m.off e.txt -o m.off; refused 2 'is both input and output'
run edit m.off e.txt -o e.txt --format off; refused 2 'is both input and output'
run edit m.off e.txt -o o.off --log e.txt; refused 2 'is both input and output'
run edit m.off e.txt -o o.off --numbers ./m.off; refused 2 'is both input and output'
run edit m.off e.txt -o o.off --log l.txt --changes ./l.txt
refused 2 '--changes and --log cannot both go to l\.txt'
run edit m.off e.txt -o o.off --log o.off; refused 2 '--output and --log cannot both go to o\.off'
run edit m.off e.txt -o - --format off --log -
refused 2 '--output and --log cannot both go to standard output'
run edit m.off e.txt -o - --format off
refused 2 'e\.txt:2: --output already writes to standard output; use --answers FILE'
run edit m.off e.txt -o o.off --changes -
refused 2 'e\.txt:2: --changes already writes to standard output'
run edit m.off e.txt -o o.off --log nowhere/l.txt; refused 4 'nowhere/l\.txt: '
only_files m.off ring.off e.txt
run edit m.off e.txt -o - --format off --answers a.csv; exits 0; prints_line '^OFF$'
run edit m.off e.txt -o o.off --answers a.csv --log -; exits 0; prints 'insert 0.5 0.25'
rm a.csv o.off
# Full disks, small disks, closed pipes, signals: as for the other commands.
awk 'BEGIN { srand(9); for (i = 0; i < 18000; i++) print i % 3 ? "insert" : "locate", rand(), rand() }' >long.txt
if [[ -w /dev/full ]]; then
    for option in --answers --changes --log --numbers; do
        run edit m.off e.txt -o o.off $option /dev/full; exits 4; says 'No space left on device'
        rm -f o.off
    done
    run edit m.off e.txt -o /dev/full --format off; exits 4; says 'No space left on device'
fi
for option in '--answers a' '--changes a' '--log a' ''; do
    last="meshwalk edit m.off long.txt -o o.ply $option, with files of at most 64 kB"
    # shellcheck disable=SC2086 # words
    (trap '' XFSZ; ulimit -f 64; exec "$meshwalk" edit m.off long.txt --skip -q -o o.ply $option) \
        >/dev/null 2>"$logs/err"
    code=$?
    exits 4; says '^meshwalk: (a|o\.ply): .*File too large'
    only_files m.off ring.off e.txt long.txt
done
last='meshwalk edit m.off long.txt | head -n 1'
{ "$meshwalk" edit m.off <(awk 'BEGIN { for (i = 0; i < 60000; i++) print "locate", i, i }') -o \
    o.ply 2>"$logs/err"; echo $? >"$logs/code"; } |
    head -n 1 >"$logs/out"
code=$(<"$logs/code")
exits 4; says_nothing; absent o.ply
mkfifo pipe
printf 'precious\n' >old.ply
for signal in INT TERM; do
    last="meshwalk edit m.off pipe -o old.ply, then SIG$signal"
    env --default-signal=INT,TERM "$meshwalk" edit m.off pipe --skip -q -o old.ply --log l \
        --changes c --numbers n --answers a \
        >"$logs/out" 2>"$logs/err" &
    child=$!
    { cat long.txt; sleep 0.3; kill -s $signal $child; sleep 0.1; } >pipe 2>/dev/null
    wait $child 2>/dev/null
    code=$?
    exits $((128 + $(kill -l $signal)))
    only_files m.off ring.off e.txt long.txt pipe old.ply
    holds "the older file is as it was" test "$(<old.ply)" == precious
done
rm pipe old.ply
too_little=0 limits=$(little_memory)
for kilobytes in $limits; do
    last="meshwalk edit, with $kilobytes kB of memory"
    (
        ulimit -v "$kilobytes"
        exec "$meshwalk" edit m.off long.txt --skip -q -o o.ply --threads 1 --log l
    ) >/dev/null 2>"$logs/err"
    code=$?
    [[ $code == 0 ]] && rm o.ply l && continue
    exits 4; says '^meshwalk: .*out of memory'; only_files m.off ring.off e.txt long.txt
    too_little=$((too_little + 1))
done
holds 'the least memory is too little' test -z "$limits" -o "$too_little" -gt 0

# --- real meshes ---
shared=${MW_SHARED:-}
"$meshwalk" triangulate "$source_tree/data/jacksboro.csv" -q -o terrain.ply
for mesh in terrain.ply "$shared/domain/greenland.node.gz"; do
    [[ -r $mesh ]] || { left_out "there is no ../shared/data"; continue; }
    run info --json "$mesh"
    read -r box < <(perl -MJSON::PP -e 'local $/; my $i = decode_json(<STDIN>); print "@{$i->{low}} @{$i->{high}}\n"' <"$logs/out")
    awk -v box="$box" 'BEGIN { srand(5); split(box, b, " ")
        for (i = 0; i < 3000; i++) {
            x = b[1] + rand() * (b[3] - b[1]); y = b[2] + rand() * (b[4] - b[2])
            if (i % 3 == 0) print "insert", x, y;
            else if (i % 3 == 1) print "remove", int(rand() * 1000); else print "locate", x, y
        } }' >e.txt
    run edit "$mesh" e.txt -o o.ply --skip -q --log l.txt; exits 0
    holds "$mesh: some lines have answers" test "$(grep -c ,inside, "$logs/out")" -gt 10
    run check o.ply; exits 0
    run edit "$mesh" l.txt -o p.ply; exits 0; says_nothing
    holds "$mesh: the log makes the same mesh" cmp o.ply p.ply
done
finish
