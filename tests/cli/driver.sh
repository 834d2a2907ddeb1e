# What the tests of the program share. A script sources this, runs the program, says what it
# expects, and ends with `finish`. It works in an empty directory of its own, "$work", which is
# removed at the end.
# shellcheck shell=bash disable=SC2034
set -u
export LC_ALL=C
meshwalk=${MESHWALK:?the program to test}
source_tree=${MW_SOURCE:?the source tree}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/meshwalk-test.XXXXXX") || exit 1
logs=$(mktemp -d "${TMPDIR:-/tmp}/meshwalk-logs.XXXXXX") || exit 1
trap 'rm -rf "$work" "$logs"' EXIT
cd "$work" || exit 1
failures=0 checks=0 last=

# run ARGUMENTS...: the program; standard output and error, and the exit code, are kept for the
# checks that follow.
run() {
    last="meshwalk $*"
    timeout 60 "$meshwalk" "$@" >"$logs/out" 2>"$logs/err"
    code=$?
}

# run_on INPUT ARGUMENTS...: the same with a text on standard input.
run_on() {
    local input=$1
    shift
    last="meshwalk $* <<<'${input:0:60}'"
    printf '%s' "$input" | timeout 60 "$meshwalk" "$@" >"$logs/out" 2>"$logs/err"
    code=${PIPESTATUS[1]}
}

fail() {
    failures=$((failures + 1))
    {
        echo "FAILED: $last"
        echo "  $*"
        echo "  exit code $code; standard error:"
        head -n 5 "$logs/err" | sed 's/^/    /'
    } >&2
    [[ ! ${MW_TEST_FIRST-} ]] || exit 1 # for tools/mutate, which asks for no more
}

exits() {
    checks=$((checks + 1))
    [[ $code == "$1" ]] || fail "the exit code should be $1"
}

# Standard output is exactly this (a final newline apart).
prints() {
    checks=$((checks + 1))
    if [[ $(<"$logs/out") != "$1" ]]; then
        fail "standard output differs from what is expected:"
        diff <(printf '%s\n' "$1") "$logs/out" | head -n 20 >&2
    fi
}

# Standard output (error) has a line that matches.
prints_line() {
    checks=$((checks + 1))
    grep -Eq -- "$1" "$logs/out" || fail "standard output should have a line like: $1"
}
says() {
    checks=$((checks + 1))
    grep -Eq -- "$1" "$logs/err" || fail "standard error should say: $1"
}
says_nothing() {
    checks=$((checks + 1))
    [[ ! -s $logs/err ]] || fail "standard error should be empty"
}

# refused CODE PATTERN: that exit code, nothing printed, and messages that begin as the contract
# says.
refused() {
    exits "$1"
    prints ''
    says "^meshwalk: .*$2"
    checks=$((checks + 1))
    ! grep -Evq '^meshwalk: ' "$logs/err" || fail "every message should begin with 'meshwalk: '"
}

# Words on a line, sorted.
words() { tr ' ' '\n' <<<"$1" | sort | xargs; }

# No file of this name; no file at all but those named.
absent() {
    checks=$((checks + 1))
    [[ ! -e $1 ]] || fail "$1 should not exist"
}
only_files() {
    checks=$((checks + 1))
    local found
    found=$(find . -mindepth 1 -maxdepth 1 -printf '%f ')
    [[ $(words "$found") == "$(words "$*")" ]] || fail "there should be no files but $*: $found"
}

# holds DESCRIPTION COMMAND...: any other condition.
holds() {
    checks=$((checks + 1))
    local what=$1
    shift
    "$@" || fail "$what"
}

is_json() { perl -MJSON::PP -e 'local $/; JSON::PP->new->decode(<STDIN>)' <"$1"; }
same_text() { cmp -s "$1" "$2"; }

# Amounts of memory, in kB, that are little: from what the program takes to start. None where a
# sanitizer takes much more.
little_memory() {
    local low=1000 high=250000 middle more
    (ulimit -v $high; "$meshwalk" --version) >/dev/null 2>&1 || return
    while ((high - low > 100)); do
        middle=$(((low + high) / 2))
        if (ulimit -v $middle; "$meshwalk" --version) >/dev/null 2>&1; then
            high=$middle
        else
            low=$middle
        fi
    done
    for more in 0 400 800 1500 2500 4000 9000 25000; do echo $((high + more)); done
}

# left_out REASON: a part is not tested here. ./test lists these in the end.
left_out_count=0
left_out() {
    left_out_count=$((left_out_count + 1))
    echo "left out: $*"
}

# What the program was built without, and this script would test, is left out.
left_out_libraries() {
    local library
    for library in Jansson Cairo GDAL; do
        grep -q "$library" "$here/$(basename "$0")" || continue
        "$meshwalk" --version | grep -Eq "^ +$library .*, (built in|found):" ||
            left_out "no $library"
    done
}

finish() {
    left_out_libraries
    echo "$checks checks, $failures failed"
    ((checks + left_out_count > 0 && failures == 0))
    exit
}

# A square of two triangles on the plane z = x + y, and one with a square hole.
square='OFF
4 2 0
0 0 0
1 0 1
1 1 2
0 1 1
3 0 1 2
3 0 2 3'
ring='OFF
8 8 0
0 0 0
3 0 0
3 3 0
0 3 0
1 1 1
2 1 1
2 2 1
1 2 1
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7'
# Two triangles that overlap.
overlap='OFF
6 2 0
0 0 0
1 0 0
0 1 0
.1 .1 0
1.1 .1 0
.1 1.1 0
3 0 1 2
3 3 4 5'
