# Turns the kernel files named as arguments into a C file that defines src/opencl/kernel_text.h.
# A char array of numbers, because a C compiler need not take string literals beyond 4095 bytes.
BEGIN {
    for (i = 0; i < 256; ++i)
        code[sprintf("%c", i)] = i
    print "#include \"opencl/kernel_text.h\"\n\nconst char rt_kernel_text[] = {"
}
function emit(text,    i, n, row) {
    n = length(text)
    row = ""
    for (i = 1; i <= n; ++i)
        row = row code[substr(text, i, 1)] ","
    total += n + 1
    print row "10,"
}
FNR == 1 {
    name = FILENAME
    sub(/^.*kernels\//, "", name)
    names = names "\"" name "\", "
    emit("#line 1 \"kernels/" name "\"")
}
{ emit($0) }
END {
    print "0};"
    print "const size_t rt_kernel_text_length = " total ";"
    print "const char *const rt_kernel_names[] = {" names "NULL};"
}
