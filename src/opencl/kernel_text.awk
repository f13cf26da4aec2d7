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
# What there is of each kind of primitives is a macro of a row: #define ...(name, names, NAMES).
/^ *kind\([a-z]+, [a-z]+, [A-Z]+\)/ {
    split($0, part, /[(,) ]+/)
    ++kinds
    kind[kinds] = part[3]
    kinds_of[kinds] = part[4]
}
/^#define [A-Z_]*\(name, names, NAMES\)/ {
    row = $2
    sub(/\(.*/, "", row)
    sub(/^[^)]*\)/, "")
    rows[row] = ""
}
row {
    rows[row] = rows[row] $0
    if (!sub(/\\$/, "", rows[row]))
        row = ""
}
# Parameters that several kernels have are macros: #define ..._PARAMETERS, continued or not.
/^#define [A-Z_]*_PARAMETERS/ {
    macro = $2
    sub(/^#define [A-Z_]*/, "")
    macros[macro] = ""
}
macro {
    macros[macro] = macros[macro] $0
    if (!sub(/\\$/, "", macros[macro]))
        macro = ""
}
# A kernel's name and parameters stand between __kernel, alone with its attributes, and its body.
signature && /^\{/ {
    parameters[++kernels] = names_of(signature)
    signature = ""
}
signature { signature = signature $0 }
/^__kernel / { signature = " " }
# "rt_shade(const int stride, __global float *colors)" to "rt_shade stride colors".
function names_of(text,    name, list, row, n, i) {
    for (name in macros)
        gsub(name, macros[name], text)
    while (match(text, /RT_KINDS\([A-Z_]*\)/)) {
        name = substr(text, RSTART + 9, RLENGTH - 10)
        list = ""
        for (i = 1; i <= kinds; ++i) {
            row = rows[name]
            gsub(/names/, kinds_of[i], row)
            gsub(/name/, kind[i], row)
            gsub(/##/, "", row)
            list = list row
        }
        text = substr(text, 1, RSTART - 1) list substr(text, RSTART + RLENGTH)
    }
    n = split(text, part, /[(,)]/)
    sub(/^.*[ *]/, "", part[1])
    list = part[1]
    for (i = 2; i < n; ++i) {
        sub(/ *$/, "", part[i])
        sub(/^.*[ *]/, "", part[i])
        list = list " " part[i]
    }
    return list
}
END {
    print "0};"
    print "const size_t rt_kernel_text_length = " total ";"
    print "const char *const rt_kernel_names[] = {" names "NULL};"
    print "const char *const rt_kernel_parameters[] = {"
    for (i = 1; i <= kernels; ++i)
        print "\"" parameters[i] "\","
    print "NULL};"
}
