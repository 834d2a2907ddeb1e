#!/usr/bin/env bash
# Hostile treatment of the program: memory limits, closed descriptors, inputs with bytes changed,
# and signals at any moment. Whatever happens, it ends by itself, with an exit code of its own, and
# an output is complete or absent.
#   HOSTILE_SECONDS  how long to go on (0: one round); HOSTILE_SEED  the first seed
# shellcheck source=../cli/driver.sh disable=SC2154
. "$(dirname "$0")/../cli/driver.sh"
seed=${HOSTILE_SEED:-1}
end=$((SECONDS + ${HOSTILE_SECONDS:-0}))
rounds=0

# A mesh and queries that take some milliseconds; edits that all succeed.
awk -v n=40 'BEGIN {
    print "OFF"; print (n + 1)^2, 2 * n^2, 0
    for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) print i, j, sin(i * 7 + j)
    for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
        v = i * (n + 1) + j
        print 3, v, v + n + 1, v + n + 2; print 3, v, v + n + 2, v + 1
    }
}' >mesh.off
awk -v OFS=, -v n=20000 \
    'BEGIN { print "x,y"; for (i = 0; i < n; i++) print (i * 0.618) % 40, (i * 0.414) % 40 }' \
    >points.csv
awk -v n=2000 'BEGIN { for (i = 0; i < n; i++) print "insert", (i * 0.618) % 40, (i * 0.414) % 40 }' >edits.txt
echo '{"type":"LineString","coordinates":[[1.5,1.5],[30.5,20.5],[10.5,33.5]]}' >lines.geojson
"$meshwalk" star --help >/dev/null || exit 1
cat >octahedron.off <<'TEXT'
OFF
6 8 0
1 0 0
-1 0 0
0 1 0
0 -1 0
0 0 1
0 0 -1
3 0 2 4
3 2 1 4
3 1 3 4
3 3 0 4
3 2 0 5
3 1 2 5
3 3 1 5
3 0 3 5
TEXT
echo '1 2 3' >rays.xyz
echo '0 0 9 0.1 0.2 -1' >lines.xyz
inputs='mesh.off points.csv edits.txt lines.geojson octahedron.off rays.xyz lines.xyz'

# One of these a line; -o OUT comes last, where there is an output.
commands=(
    'info mesh.off'
    'check mesh.off'
    'locate mesh.off points.csv -q -o out.csv'
    'locate mesh.off points.csv -q --walk straight --start two-level-grid -o out.csv'
    'sample mesh.off points.csv -q -o out.csv'
    'triangulate points.csv -q -o out.off'
    'triangulate points.csv --constraints lines.geojson -q -o out.off'
    'edit mesh.off edits.txt -q --skip -o out.off'
    'star octahedron.off rays.xyz -o out.csv'
    'probe octahedron.off lines.xyz -o out.csv'
    'walk mesh.off --from 1,1 --to 30,20 -o out.csv'
)

# The complete output of each command, to compare with.
declare -A complete
for command in "${commands[@]}"; do
    # shellcheck disable=SC2086
    "$meshwalk" $command >"$logs/out" 2>"$logs/err" ||
        { echo "$command: $(<"$logs/err")" >&2; exit 1; }
    complete[$command]=absent
    [[ $command != *' -o '* ]] || complete[$command]=$(cat out.* | cksum)
    rm -f out.*
done

# draw N: sets `drawn` to a number below N. Not a subshell: RANDOM would not go on then.
draw() { drawn=$(((RANDOM * 32768 + RANDOM) % $1)); }

# The program ended by itself, with one of its codes, said why, and an output is complete or absent.
# A signal may come when the output has its name already: then it is complete, whatever the code.
expect_end() { # expect_end COMMAND CODES [silent]
    local output=absent
    checks=$((checks + 3))
    [[ " $2 " == *" $code "* ]] || fail "seed $seed: the exit code should be one of: $2"
    [[ -z $(find . -name 'out.*') ]] || output=$(cat out.* | cksum)
    if [[ $code == 0 || $output != absent ]]; then
        [[ $output == "${complete[$1]}" ]] || fail "seed $seed: the output should be complete"
    fi
    if ((code > 0 && code < 128)); then
        [[ -s $logs/err || ${3:-} == silent ]] || fail "seed $seed: it should say why"
        [[ $output == absent ]] || fail "seed $seed: no output should be left"
    fi
    rm -f out.*
}

memory_limit() { # kilobytes of address space, from too few to enough
    draw 60000
    local kilobytes=$((4000 + drawn))
    last="(ulimit -v $kilobytes) meshwalk $1"
    # shellcheck disable=SC2086
    (ulimit -v $kilobytes; exec timeout 60 "$meshwalk" $1) >"$logs/out" 2>"$logs/err"
    code=$?
    # below what the program itself needs, the loader ends it
    [[ $code == 127 ]] || expect_end "$1" '0 4'
    rm -f out.*
}

closed_descriptors() {
    draw 8
    local closed=$drawn
    last="meshwalk $1, closed: $closed"
    : >"$logs/out" && : >"$logs/err"
    (
        ((closed & 1)) && exec <&-
        ((closed & 2)) && exec >&-
        ((closed & 4)) && exec 2>&-
        # shellcheck disable=SC2086
        exec "$meshwalk" $1
    ) >"$logs/out" 2>"$logs/err"
    code=$?
    expect_end "$1" '0 4' silent
    for input in $inputs; do
        [[ -s $input ]] || fail "seed $seed: $input is gone"
    done
}

# One input gets some bytes changed. What is read then is another mesh: only the end is looked at.
changed_input() {
    local names name
    read -ra names <<<"$inputs"
    draw ${#names[@]}
    name=${names[$drawn]}
    draw 1000000000
    cp "$name" saved
    perl -e 'srand shift; local $/; open F, "<", $ARGV[0]; $_ = <F>; close F;
        for (1 .. 1 + rand 4) {
            my $at = int rand length;
            my $new = ("", chr int rand 256, "1e999", "-1", "\n", "99999999999", " ")[rand 7];
            substr($_, $at, int rand 3) = $new;
        }
        open F, ">", $ARGV[0]; print F $_' "$drawn" "$name"
    last="meshwalk $1, $name changed with seed $seed"
    # shellcheck disable=SC2086
    timeout 60 "$meshwalk" $1 >"$logs/out" 2>"$logs/err"
    code=$?
    checks=$((checks + 1))
    ((code <= 4)) || fail "seed $seed: the exit code should be 0 to 4"
    ((code < 2)) || [[ -z $(find . -name 'out.*') ]] ||
        fail "seed $seed: no output should be left: $(ls -A)"
    rm -f out.*
    mv saved "$name"
}

# A signal after 0 to 60 ms: the program is ended by it, or was done.
interrupted() {
    local name=INT pause
    draw 2
    ((drawn)) && name=TERM
    draw 60
    pause=$drawn
    last="meshwalk $1, $name after $pause ms"
    # a shell without job control starts what stands in the background with SIGINT ignored
    # shellcheck disable=SC2086
    perl -e '$SIG{INT} = "DEFAULT"; exec @ARGV' "$meshwalk" $1 >"$logs/out" 2>"$logs/err" &
    local child=$!
    sleep "0.$(printf '%03d' "$pause")"
    kill -s "$name" $child 2>/dev/null
    wait $child
    code=$?
    expect_end "$1" '0 130 143' silent
}

treatments=(closed_descriptors changed_input interrupted)
# A sanitizer needs more address space than any limit leaves.
if (ulimit -v 250000; "$meshwalk" --version) >/dev/null 2>&1; then treatments+=(memory_limit); fi

while :; do
    RANDOM=$((seed % 32768))
    for command in "${commands[@]}"; do
        for treatment in "${treatments[@]}"; do $treatment "$command"; done
    done
    rounds=$((rounds + 1)) seed=$((seed + 1))
    ((SECONDS < end && failures == 0)) || break
done
echo "$rounds rounds to seed $((seed - 1))"
finish
