#!/usr/bin/env bash
# probe: triangles that a line touches, on surfaces small enough to know the answers; what is
# refused; real surfaces.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
header=x,y,z,status,triangle,distance,w0,w1,w2

# A cube whose fronts face out: triangles 0, 1 below, 2, 3 on top, 4 to 11 round it.
cube='OFF
8 12 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
3 0 2 1
3 0 3 2
3 4 5 6
3 4 6 7
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7'
printf '%s\n' "$cube" >cube.off
# From above, also from within and from beyond; upwards; on an edge of two triangles, at a corner,
# on the rim; sideways.
queries='.75,.25,2,0,0,-1
.25,.75,2,0,0,-9
.75,.25,.5,0,0,-1
.75,.25,-3,0,0,-.5
.75,.25,2,0,0,1
.5,.5,2,0,0,-3
0,0,3,0,0,-1
.5,0,4,0,0,-1
7,.25,.5,-2,0,0
-1,.5,.75,1,0,0
'
answers="$header
0.75,0.25,2,hit,2,1,0.25,0.5,0.25
0.25,0.75,2,hit,3,1,0.25,0.25,0.5
0.75,0.25,0.5,hit,2,-0.5,0.25,0.5,0.25
0.75,0.25,-3,hit,2,-4,0.25,0.5,0.25
0.75,0.25,2,hit,0,-2,0.25,0.25,0.5
0.5,0.5,2,hit,2,1,0.5,0,0.5
0,0,3,hit,2,2,1,0,0
0.5,0,4,hit,2,3,0.5,0.5,0
7,0.25,0.5,hit,7,6,0.5,0.25,0.25
-1,0.5,0.75,hit,11,1,0.25,0.5,0.25"
names() { "$meshwalk" probe --help all | sed -nE "/ --$1 NAME/,/^ {0,6}-/p" |
    sed -nE 's/^ {26}.([a-z-]+). .*/\1/p'; }
starts=$(names start)
holds "there are starts" test "$(wc -w <<<"$starts")" -ge 4
for certain in '' --certain; do
    run_on "$queries" probe --only-answers $certain cube.off -; exits 0; says_nothing
    prints "$answers"
    for start in $starts; do
        run_on "$queries" probe --only-answers $certain --start "$start" --seed 3 --threads 2 \
            cube.off -
        exits 0; prints "$answers"
    done
    for options in '--samples 1' '--samples 100' '--iterations 50' '--race 2' '--weld' '--any' \
        '--strict'; do
        # shellcheck disable=SC2086 # words
        run_on "$queries" probe --only-answers $certain $options cube.off -; exits 0
        prints "$answers"
    done
done
run_on "$(cat cube.off)" probe --only-answers - <(printf '%s' "$queries"); exits 0
prints "$answers"

# Nothing there: walks cannot know it. No motion, no number.
away='2,2,2,0,0,1
.75,.25,2,1,0,0
'
run_on "$away" probe --only-answers --certain --strict cube.off -; exits 0
prints "$header
2,2,2,none,-1,,,,
0.75,0.25,2,none,-1,,,,"
run_on "$away" probe --only-answers cube.off -; exits 0; says_nothing
prints "$header
2,2,2,limit,-1,,,,
0.75,0.25,2,limit,-1,,,,"
run_on "$away" probe --only-answers --strict cube.off -; exits 1
bad='1,1,1,0,0,0
nan,0,0,0,0,1
0,0,0,0,inf,1
'
for certain in '' --certain; do
    run_on "$bad" probe --only-answers $certain cube.off -; exits 0; says_nothing
    prints "$header
1,1,1,bad,-1,,,,
nan,0,0,bad,-1,,,,
0,0,0,bad,-1,,,,"
    run_on "$bad" probe --only-answers $certain --strict cube.off -; exits 1
done

# The distance counts on either side, the limit included.
for distance in 1 2 1e9; do
    run_on $'.75,.25,2,0,0,-7\n' probe --only-answers --max-distance $distance cube.off -; exits 0
    prints_line ',hit,2,1,'
    run_on $'.75,.25,0,0,0,-7\n' probe --only-answers --certain --max-distance $distance cube.off -
    exits 0; prints_line ',hit,2,-1,'
done
run_on $'.75,.25,2,0,0,-7\n' probe --only-answers --max-distance 0.999 cube.off -; exits 0
prints_line ',limit,-1,,,,$'
run_on $'.75,.25,2,0,0,-7\n' probe --only-answers --certain --max-distance 0.999 cube.off -; exits 0
prints_line ',none,-1,,,,$'

# 0 leaves what is at the point, on the outermost facets and far from the origin too; without the
# option all is in reach.
at='.75,.25,1,0,0,-1
.75,.25,1.0000000000000002,0,0,-1
.3,.1,0,1e-300,0,1e-300
.3,.1,0,0,0,1e300
1,1,1,-1,-1,-1
1,1,.3,-1,0,0
.75,.25,1e-320,0,0,1
'
for certain in '' --certain; do
    for zero in 0 0.0 -0; do
        run_on "$at" probe --only-answers $certain --max-distance $zero cube.off -; exits 0
        says_nothing
        states=$(sed 1d "$logs/out" | awk -F, '{ printf "%s %s ", $4, $6 }')
        none=limit; [[ $certain ]] && none=none
        holds "what is at the point is touched: $states" \
            test "$states" == "hit 0 $none  hit 0 hit 0 hit 0 hit 0 $none  "
    done
    run_on "$at" probe --only-answers $certain cube.off -; exits 0
    holds "without a limit all are touched" test "$(grep -c ',hit,' "$logs/out")" == 7
    run_on "$at" probe --only-answers $certain --max-distance 1e-319 cube.off -; exits 0
    prints_line '^0.75,0.25,[0-9.]+e-[0-9]+,hit,'
done

# Fronts only: two plates whose fronts face up, at heights 0 and 3, and one that faces down at 1.
printf 'OFF\n9 3 0\n%s3 0 1 2\n3 3 5 4\n3 6 7 8\n' \
    "$(for z in 0 1 3; do printf '0 0 %s\\n4 0 %s\\n0 4 %s\\n' $z $z $z; done | sed 's/\\n/\n/g')"$'\n' >plates.off
plates='1,1,5,0,0,-1
1,1,1,0,0,-1
1,1,2,0,0,-1
1,1,2,0,0,1
1,1,1.5,0,0,-1
'
run_on "$plates" probe --only-answers --certain plates.off -; exits 0
prints "$header
1,1,5,hit,2,2,0.5,0.25,0.25
1,1,1,hit,0,1,0.5,0.25,0.25
1,1,2,hit,2,-1,0.5,0.25,0.25
1,1,2,hit,1,-1,0.5,0.25,0.25
1,1,1.5,hit,0,1.5,0.5,0.25,0.25"
run_on "$plates" probe --only-answers plates.off -; exits 0
for row in '1,1,5,hit,(0,5|2,2)' '1,1,2,hit,1,-1'; do prints_line "^$row,0\.5,0\.25,0\.25\$"; done

# Columns: six, by a header or by --columns.
touched="$header"$'\n'0.75,0.25,2,hit,2,1,0.25,0.5,0.25
for input in $'mx,my,mz,x,y,z\n0,0,-1,.75,.25,2' $'id;X;Y;Z;MX;MY;MZ\n5;.75;.25;2;0;0;-1' \
    $'.75 .25 2 0 0 -1' $'a,b,c,d,e,f\n.75,.25,2,0,0,-1' $'x,y,z,nx,ny,nz\n.75,.25,2,0,0,-1'; do
    run_on "$input"$'\n' probe --only-answers cube.off -; exits 0; prints "$touched"
done
run_on $'.75 .25 2 0 0 -1 99\n' probe cube.off -
refused 2 'which of its 7 columns are x,y,z,mx,my,mz\?'
table=$'t,x,y,z,u,v,w\n1,.75,.25,2,0,0,-1\n'
run_on "$table" probe --only-answers --columns x,y,z,u,v,w cube.off -; exits 0; prints "$touched"
run_on "$table" probe --columns x,y,z,u,v,w cube.off -; exits 0
prints $'t,x,y,z,u,v,w,status,triangle,distance,w0,w1,w2\n1,.75,.25,2,0,0,-1,hit,2,1,0.25,0.5,0.25'
run_on "$table" probe --only-answers --columns 2,3,4,5,6,7 cube.off -; exits 0; prints "$touched"
run_on "$table" probe --only-answers cube.off -
refused 2 'standard input: which of its 7 columns are x,y,z,mx,my,mz\? They are: '
run_on "$table" probe --only-answers --columns x,y,z cube.off -
refused 2 "'--columns' must name 6 columns, x,y,z,mx,my,mz, not 3"
printf '.75,.25,2,0,0\n' >five.csv
run probe --only-answers cube.off five.csv -o o.csv
refused 3 'five\.csv: has 5 columns, but a row is x,y,z,mx,my,mz'; absent o.csv

# Files that are none, or not of the kind wanted.
printf '%s' "$queries" >q.csv
run probe --only-answers missing.off q.csv; refused 3 'missing\.off: .*No such file'
run probe --only-answers cube.off missing.csv; refused 3 'missing\.csv: .*No such file'
run probe --only-answers q.csv q.csv; refused 3 'q\.csv: holds points'
run probe --only-answers cube.off q.csv -o cube.off; refused 2 'is both input and output'
printf '1,2,3,4,5,6\n1,2,3,4,x,6\n' >bad.csv
run probe --only-answers cube.off bad.csv -o o.csv; refused 3 'bad\.csv:2: '; absent o.csv
: >empty.csv
run probe --only-answers cube.off empty.csv; exits 0; prints "$header"
printf 'OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n' >none.off
run probe --only-answers none.off q.csv; refused 3 'none\.off: '
# Three triangles at one edge.
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n' >three.off
run_on $'.25,.25,2,0,0,-1\n' probe --only-answers three.off - -o o.csv
refused 3 "three\.off: "; says "'meshwalk check --as surface three\.off' lists every defect, 'meshwalk view' shows it; --any"
absent o.csv
for certain in '' --certain; do
    run_on $'.25,.25,2,0,0,-1\n' probe --only-answers $certain --any three.off -; exits 0
    prints_line '^0.25,0.25,2,hit,0,2,0.5,0.25,0.25$'
done

# Output that cannot be written.
last='meshwalk probe cube.off q.csv >&-'
"$meshwalk" probe cube.off q.csv >&- 2>"$logs/err"
code=$? && : >"$logs/out"
exits 4; says '^meshwalk: '
if [[ -w /dev/full ]]; then
    run probe --only-answers cube.off q.csv -o /dev/full; exits 4; says 'No space left on device'
fi

# Statistics.
run_on "$queries$away$bad" probe --only-answers --stats cube.off -; exits 0
says '^points +15$'; says '^hit +10$'; says '^limit +2$'; says '^none +0$'; says '^bad +3$'
says '^certain +no$'
says '^samples +[1-9]'; says '^triangles per query +[0-9]'; says '^box bytes +0$'
says '^surface bytes +[1-9]'
run_on "$queries$away$bad" probe --only-answers --stats --json --certain --start random cube.off -
exits 0
holds "the statistics are JSON" is_json "$logs/err"
says '"none": 2'; says '"certain": true'; says '"box_bytes": [1-9]'; says '"start": "random"'

# More probes than one block holds: in order, and the same for any number of threads.
awk 'BEGIN { for (i = 0; i < 300000; i++)
    printf "%.3f,%.3f,%d,%.2f,%.2f,-1\n",
    i % 1009 / 800 - .1, i % 503 / 400 - .1, i % 5, i % 7 / 9, i % 3 / 9 }' >many.csv
run probe --only-answers --threads 1 cube.off many.csv -o one.csv; exits 0
run probe --only-answers --threads 2 cube.off many.csv -o two.csv; exits 0
holds "one thread and two print the same" same_text one.csv two.csv
paste -d, many.csv <(tail -n +2 two.csv) |
    awk -F, '$1 != $7 || $2 != $8 || $3 != $9 { exit 1 } END { if (NR != 300000) exit 1 }'
holds "there is a row for each, in order" test "${PIPESTATUS[*]}" == "0 0"
head -n 20000 many.csv >some.csv
for threads in 1 2; do
    run probe --only-answers --certain --threads $threads cube.off some.csv -o $threads.csv; exits 0
done
holds "one thread and two print the same" same_text 1.csv 2.csv

# Other parts of the line, other faces, points inside.
printf '%s\n' .75,.25,.5,0,0,1 .75,.25,.5,.75,.25,1 .75,.25,.5,.75,.25,.75 >rays.csv
run probe --only-answers --certain --extent ray --faces both cube.off rays.csv; exits 0
holds "a ray meets a back" grep -q '^0.75,0.25,0.5,hit,2,0.5,' "$logs/out"
run probe --only-answers --certain --extent segment --faces back cube.off rays.csv; exits 0
holds "a segment ends" test "$(cut -d, -f4 "$logs/out" | tr '\n' ' ')" = "status hit hit none "
run probe --only-answers --certain --min-distance .6 cube.off rays.csv; exits 0
holds "a least distance" test "$(sed -n 2p "$logs/out")" = "0.75,0.25,0.5,none,-1,,,,"
printf '%s\n' .5,.5,.5 0,0,0 .5,.5,1 2,0,0 nan,0,0 >points.csv
run probe --only-answers --inside cube.off points.csv; exits 0
holds "inside" test "$(cut -d, -f4 "$logs/out" | tr '\n' ' ')" = "status inside on on outside bad "
head -n 16 cube.off | sed '2s/12/6/' >sheet.off
run probe --inside sheet.off points.csv; exits 3

# All triangles in their order, on either side; of those at one place the lowest only.
printf '%s\n' .75,.25,.5,0,0,1 .5,.5,2,0,0,-1 2,2,2,0,0,1 0,0,0,0,0,0 nan,0,0,0,0,1 >rays.csv
run probe --only-answers --certain --all --faces both cube.off rays.csv; exits 0; says_nothing
prints "$header,back
0.75,0.25,0.5,hit,0,-0.5,0.25,0.25,0.5,0
0.75,0.25,0.5,hit,2,0.5,0.25,0.5,0.25,1
0.5,0.5,2,hit,2,1,0.5,0,0.5,0
0.5,0.5,2,hit,3,1,0.5,0.5,0,0
0.5,0.5,2,hit,0,2,0.5,0.5,0,1
0.5,0.5,2,hit,1,2,0.5,0,0.5,1
2,2,2,none,-1,,,,,
0,0,0,bad,-1,,,,,
nan,0,0,bad,-1,,,,,"
run probe --only-answers --certain --all --one-per-place --faces both --strict cube.off rays.csv
exits 1
holds "one for each place" test "$(cut -d, -f5 "$logs/out" | tr '\n' ' ')" = \
    "triangle 0 2 2 0 -1 -1 -1 "
run probe --only-answers --certain --all --extent segment --faces back --max-distance 1 \
    cube.off rays.csv
exits 0
holds "what counts, counts" test "$(cut -d, -f4,5 "$logs/out" | tr '\n' ' ')" = \
    "status,triangle hit,2 hit,3 hit,5 hit,10 hit,11 none,-1 none,-1 bad,-1 bad,-1 "
run_on $'name;x;y;z;mx;my;mz\na;,5;,25;3;0;0;-1\n' probe --certain --all --faces both cube.off -
exits 0; says_nothing
prints 'name;x;y;z;mx;my;mz;status;triangle;distance;w0;w1;w2;back
a;,5;,25;3;0;0;-1;hit;2;2;0,5;0,25;0,25;0
a;,5;,25;3;0;0;-1;hit;0;3;0,5;0,25;0,25;1'
for threads in 1 2; do
    run probe --only-answers --certain --all --threads $threads cube.off many.csv -o $threads.csv
    exits 0
done
holds "one thread and two print the same" same_text 1.csv 2.csv
run probe --only-answers --certain cube.off many.csv -o nearest.csv; exits 0
cut -d, -f1-3 1.csv | uniq >1.points; cut -d, -f1-3 nearest.csv | uniq >2.points
holds "every probe has rows, in order" same_text 1.points 2.points

# The nearest point.
printf '%s\n' .5,.25,3 .25,.5,.5 9,0,0 nan,0,0 >points.csv
run probe --only-answers --nearest cube.off points.csv; exits 0; says_nothing
prints "x,y,z,status,triangle,distance,px,py,pz,w0,w1,w2
0.5,0.25,3,hit,2,2,0.5,0.25,1,0.5,0.25,0.25
0.25,0.5,0.5,hit,10,0.25,0,0.5,0.5,0.5,0,0.5
9,0,0,hit,0,8,1,0,0,0,0,1
nan,0,0,bad,-1,,,,,,,"
run probe --only-answers --nearest --max-distance .25 --strict cube.off points.csv; exits 1
holds "no farther" test "$(cut -d, -f4 "$logs/out" | tr '\n' ' ')" = "status none hit none bad "
for wrong in '--extent ray' '--faces both' '--min-distance 1' '--inside --certain' \
    '--certain --min-distance 2 --max-distance 1' --all '--certain --one-per-place' \
    '--nearest --certain' '--nearest --inside' '--nearest --all' '--nearest --extent ray'; do
    # shellcheck disable=SC2086
    run probe $wrong cube.off rays.csv; exits 2
done

# Real surfaces, where they are at hand: what walks find, certain probes find, or something nearer.
data=${MW_SHARED:-}/surface
[[ -d $data ]] || { left_out "there is no ../shared/data"; finish; }
for file in bunny_closed.off.gz pawn.obj knot2.off.gz shark_holes.off.gz plate_holes.stl \
    bunny_zipper.ply.gz; do
    run info --as surface --json "$data/$file"; exits 0
    perl -MJSON::PP -e 'local $/; my $f = decode_json(<STDIN>); my ($l, $h) = @{$f}{qw(low high)}; srand 5;
        for (1 .. 1000) {
            print join(",", (map { $l->[$_] + rand() * ($h->[$_] - $l->[$_]) } 0 .. 2),
                map { rand() - .5 } 0 .. 2), "\n"
        }' \
        <"$logs/out" >lines.csv
    run probe --only-answers --any --certain --strict "$data/$file" lines.csv -o certain.csv
    exits 0
    run probe --only-answers --any "$data/$file" lines.csv -o walks.csv; exits 0
    holds "$file: some are touched" grep -q ',hit,' walks.csv
    paste -d, walks.csv certain.csv | awk -F, 'NR > 1 && $4 == "hit" {
            a = $6 < 0 ? -$6 : $6; b = $15 < 0 ? -$15 : $15;
            if ($13 != "hit" || b > a) { print; exit 1 } }
        NR > 1 && $4 != "hit" && $4 != "limit" { print; exit 1 }' >"$logs/differ"
    holds "$file: walks and certain probes agree: $(<"$logs/differ")" test ! -s "$logs/differ"
done
finish
