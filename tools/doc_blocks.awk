# tools/doc_blocks.awk: take the blocks of code out of a page of documentation, so that they can be
# run.
#   awk -f tools/doc_blocks.awk -v prefix=DIR/NAME PAGE.md
# Block number N becomes DIR/NAME_N.c or DIR/NAME_N.sh (N with two digits); an ```output block that
# follows it becomes DIR/NAME_N.expected. Blocks of other kinds, and their output, are left out.
# Prints the names of the .c and .sh files.
/^```/ && file != "" { close(file); file = ""; next }
/^```(c|sh)$/ {
    kind = substr($0, 4)
    base = sprintf("%s_%02d", prefix, ++count)
    file = base "." kind
    printf "" > file
    print file
    next
}
/^```output$/ && base != "" { file = base ".expected"; printf "" > file; next }
/^```/ { file = "/dev/null"; base = ""; next }
file != "" { print > file }
