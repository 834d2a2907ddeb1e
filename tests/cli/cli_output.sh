#!/usr/bin/env bash
# Output: complete or not at all, whatever goes wrong while it is written; and never over an input.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
printf '%s\n' "$square" >m.off
awk 'BEGIN { for (i = 0; i < 20000; i++) printf "%.4f %.4f\n", (i % 141) / 140, (i % 139) / 138 }' \
    >p.xyz

# A full disk: code 4 and a message, for every command.
if [[ -w /dev/full ]]; then
    for arguments in --help --version 'locate --help' 'info m.off' 'check m.off' \
        'locate m.off p.xyz' \
        'sample m.off p.xyz' 'triangulate p.xyz -o - --format ply'; do
        last="meshwalk $arguments >/dev/full"
        # shellcheck disable=SC2086 # words
        "$meshwalk" $arguments >/dev/full 2>"$logs/err"
        code=$? && : >"$logs/out"
        exits 4; says 'No space left on device'
    done
    run locate m.off p.xyz -o /dev/full; exits 4; says 'No space left on device'
fi
# A file size limit stands for a small disk: nothing is left under the name or any other.
for arguments in 'locate m.off p.xyz -o out.csv' 'sample m.off p.xyz -o out.csv' \
    'triangulate p.xyz -o out.ply' \
    'triangulate p.xyz -o out.node'; do
    last="meshwalk $arguments, with files of at most 64 kB"
    # shellcheck disable=SC2086 # words
    (trap '' XFSZ; ulimit -f 64; exec "$meshwalk" $arguments) >"$logs/out" 2>"$logs/err"
    code=$?
    exits 4; says '^meshwalk: out\.[a-z]+: .*File too large'
    only_files m.off p.xyz
done

# Too little memory: code 4 and a message, or a complete answer; never a crash, and no file but a
# complete one.
too_little=0 limits=$(little_memory)
for kilobytes in $limits; do
    for arguments in 'locate m.off p.xyz -o out.csv' 'triangulate p.xyz -q -o out.ply' \
        'info m.off -o out.txt'; do
        last="meshwalk $arguments --threads 1, with $kilobytes kB of memory"
        # shellcheck disable=SC2086 # words
        (ulimit -v "$kilobytes"; exec "$meshwalk" $arguments --threads 1) >"$logs/out" 2>"$logs/err"
        code=$?
        [[ $code == 0 ]] && rm out.* && continue
        exits 4; says '^meshwalk: .*out of memory'; only_files m.off p.xyz
        too_little=$((too_little + 1))
    done
done
holds 'the least memory is too little for all three' test -z "$limits" -o "$too_little" -ge 3

# A closed pipe: code 4, no message.
for arguments in 'locate m.off p.xyz' 'sample m.off p.xyz' \
    'triangulate p.xyz -q -o - --format ply'; do
    last="meshwalk $arguments | head -n 1"
    # shellcheck disable=SC2086 # words
    { "$meshwalk" $arguments 2>"$logs/err"; echo $? >"$logs/code"; } | head -n 1 >"$logs/out"
    code=$(<"$logs/code")
    # A pipe may hold all of a short output before it is closed.
    holds "the code is 4, or 0 where all fitted" test "$code" == 4 -o "$code" == 0
    says_nothing
done
awk 'BEGIN { for (i = 0; i < 60000; i++) printf "%.4f %.4f\n", (i % 141) / 140, (i % 139) / 138 }' \
    >long.xyz
last='meshwalk locate m.off long.xyz | head -n 1'
{ "$meshwalk" locate m.off long.xyz 2>"$logs/err"; echo $? >"$logs/code"; } | head -n 1 >"$logs/out"
code=$(<"$logs/code")
exits 4; says_nothing
rm long.xyz

# A standard output that is closed: code 4, and no file of ours takes its place.
last='meshwalk locate m.off p.xyz >&-'
"$meshwalk" locate m.off p.xyz >&- 2>"$logs/err"
code=$? && : >"$logs/out"
exits 4; says '^meshwalk: '
holds "the mesh is untouched" test "$(<m.off)" == "$square"

# Interrupted while writing: the program ends by the signal, nothing is left, and an older file
# stays.
mkfifo pipe
printf 'precious\n' >old.csv
for signal in INT TERM; do
    for target in out.csv old.csv; do
        last="meshwalk locate m.off pipe -o $target, then SIG$signal"
        env --default-signal=INT,TERM "$meshwalk" locate m.off pipe -o "$target" >"$logs/out" \
            2>"$logs/err" &
        child=$!
        # The writer sends more than a block and keeps the pipe open, so that the program waits for
        # more.
        { for _ in {1..15}; do cat p.xyz; done; sleep 0.3; kill -s $signal $child; sleep 0.1; } \
            >pipe 2>/dev/null
        wait $child 2>/dev/null
        code=$?
        exits $((128 + $(kill -l $signal)))
        only_files m.off p.xyz pipe old.csv
        holds "the older file is as it was" test "$(<old.csv)" == precious
    done
done
rm pipe old.csv

# An output that is an input is refused before anything is written, also through links and as half
# of a pair.
ln -s m.off link.off
ln p.xyz hard.xyz
same() { # same ARGUMENTS...
    run "$@"; refused 2 'is both input and output'
    holds "the inputs are untouched" test "$(<m.off)" == "$square" -a "$(wc -l <p.xyz)" == 20000
}
same locate m.off p.xyz -o m.off
same locate m.off p.xyz -o p.xyz
same locate m.off p.xyz -o ./p.xyz
same locate m.off p.xyz -o hard.xyz
same locate link.off p.xyz -o m.off
same locate m.off p.xyz -o link.off
same sample m.off p.xyz -o p.xyz
same info m.off -o m.off
same check m.off -o link.off
same triangulate p.xyz -o p.xyz --format off
"$meshwalk" triangulate p.xyz -q -o pair.node || fail "no pair"
before=$(cksum pair.node pair.ele)
run locate pair.node p.xyz -o pair.ele; refused 2 'is both input and output'
run locate pair.ele p.xyz -o pair.node; refused 2 'is both input and output'
run locate pair p.xyz -o pair.ele; refused 2 'is both input and output'
run triangulate pair.node -o pair.ele; refused 2 'is both input and output'
holds "the pair is untouched" test "$(cksum pair.node pair.ele)" == "$before"
last='meshwalk locate m.off p.xyz >>p.xyz'
"$meshwalk" locate m.off p.xyz >>p.xyz 2>"$logs/err"
code=$? && : >"$logs/out"
exits 2
holds "standard output is not an input" test "$(wc -l <p.xyz)" == 20000
rm link.off hard.xyz pair.node pair.ele

# Places where nothing can be written.
mkdir place
run locate m.off p.xyz -o place; exits 4; says '^meshwalk: place: '
run locate m.off p.xyz -o nowhere/out.csv; exits 4; says '^meshwalk: nowhere/out\.csv: '
run triangulate p.xyz -o nowhere/out.ply; exits 4; says '^meshwalk: nowhere/out\.ply: '
only_files m.off p.xyz place
holds "the directory is empty" test -z "$(ls -A place)"

# An older file is replaced as a whole, and keeps being a file that others may read.
printf 'old\n' >new.csv; chmod 644 new.csv
run locate m.off p.xyz -o new.csv; exits 0
holds "the new file is complete" test "$(wc -l <new.csv)" == 20001
umask 022
run locate m.off p.xyz -o fresh.csv; exits 0
holds "a fresh file has the mode that the umask says: $(stat -c %a fresh.csv)" test \
    "$(stat -c %a fresh.csv)" == 644

# Progress is shown on a terminal when the work takes longer than a second, and only then.
# on_terminal SECONDS ARGUMENTS...: what a terminal shows while the points take so long to come
on_terminal() {
    local seconds=$1
    shift
    last="meshwalk $* on a terminal, with points that take $seconds s"
    code=0
    script -qec "sh -c '{ head -n 9 p.xyz; sleep $seconds; } | \"$meshwalk\" $* >/dev/null'" \
        /dev/null </dev/null \
        >"$logs/terminal" 2>&1
}
if script -qec true /dev/null </dev/null >/dev/null 2>&1; then # not where no terminal can be made
    on_terminal 1.8 locate m.off -
    holds "progress is shown" grep -q 'locating standard input, 1 s' "$logs/terminal"
    on_terminal 1.8 locate --quiet m.off -
    holds "--quiet shows none" test ! -s "$logs/terminal"
    on_terminal 0.3 locate m.off -
    holds "short work shows none" test ! -s "$logs/terminal"
fi
run_on "$(head -n 9 p.xyz; sleep 1.5)" locate m.off -; exits 0; says_nothing
finish
