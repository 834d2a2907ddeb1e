# tools/positions.awk: irregular query positions over the Jacksboro model, some of them outside, as
# CSV x,y.
#   awk -f tools/positions.awk -v count=200000 data/jacksboro.csv > positions.csv
# The positions are uniform over the extent of the points read, enlarged by 2 % on every side. The
# generator is x = 16807 x mod (2^31 - 1) [Park, Miller 1988], so every awk writes the same
# positions.
BEGIN { FS = ","; state = 20240607; if (!count) count = 200000 }
function uniform() { state = (state * 16807) % 2147483647; return state / 2147483647 }
FNR == 1 { next } # the header
FNR == 2 { x0 = x1 = $1 + 0; y0 = y1 = $2 + 0; next }
{
    if ($1 + 0 < x0) x0 = $1 + 0
    if ($1 + 0 > x1) x1 = $1 + 0
    if ($2 + 0 < y0) y0 = $2 + 0
    if ($2 + 0 > y1) y1 = $2 + 0
}
END {
    width = x1 - x0; height = y1 - y0
    print "x,y"
    for (i = 0; i < count; i++) {
        x = x0 + width * (1.04 * uniform() - 0.02)
        printf "%.3f,%.3f\n", x, y0 + height * (1.04 * uniform() - 0.02)
    }
}
