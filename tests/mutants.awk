# Writes mutants of one kernel file: name (below kernels/), most (0: all), seed, and the file with
# those that are known to change nothing are -v variables; the file is the argument. One a line,
# with tabs between: line, column, what stands there, what comes in its place, the line as it then
# is. A known one that is none any more ends it with an error, on standard error.
#
# Mutated is what a token says: comparisons, signs, constants, logic, extremes, the component of a
# vector. Comments and preprocessor lines stay, but the bodies of macros are code as any.

BEGIN {
    swap["<"] = "<="; swap["<="] = "<"; swap[">"] = ">="; swap[">="] = ">"
    swap["=="] = "!="; swap["!="] = "=="
    swap["+"] = "-"; swap["-"] = "+"; swap["/"] = "*"; swap["+="] = "-="; swap["-="] = "+="
    swap["&&"] = "||"; swap["||"] = "&&"; swap["&"] = "|"; swap["|"] = "&"
    swap["fmin"] = "fmax"; swap["fmax"] = "fmin"; swap["min"] = "max"; swap["max"] = "min"
    swap["floor"] = "ceil"
    swap["LESSER"] = "GREATER"; swap["GREATER"] = "LESSER"
    swap["LEAST"] = "MOST"; swap["MOST"] = "LEAST"
    swap[".x"] = ".y"; swap[".y"] = ".z"; swap[".z"] = ".x"
    while ((getline entry <known) > 0)
        if (index(entry, name ": ") == 1)
            is_known[substr(entry, length(name) + 3)] = 1
}

# The token at the start of `text`: its length.
function token(text) {
    if (match(text, /^[A-Za-z_][A-Za-z_0-9]*/)) return RLENGTH
    if (match(text, /^0x[0-9a-fA-F.]+(p[+-]?[0-9]+)?[fFuUlL]*/)) return RLENGTH
    if (match(text, /^([0-9]+\.?[0-9]*|\.[0-9]+)(e[+-]?[0-9]+)?[fFuUlL]*/)) return RLENGTH
    if (match(text, /^(<<=|>>=|->[xyz]|->|\.[xyz]|<<|>>|<=|>=|==|!=|&&|\|\||##|[-+*\/%&|^]=|\+\+|--)/))
        return RLENGTH
    return 1
}

# What comes in the place of a token, "" for nothing to try and " " for nothing at all.
function instead(it, before, after,    is_binary) {
    is_binary = before ~ / $/ && after ~ /^( |$)/
    if (it ~ /^(\.|->)[xyz]$/)
        return after ~ /^[A-Za-z_0-9]/ ? "" : \
               (it ~ /^->/ ? "->" : ".") substr(swap["." substr(it, length(it))], 2)
    if (it ~ /^[-+\/&|]$/ && !is_binary)
        return it == "-" && before !~ /[A-Za-z_0-9]$/ ? " " : ""
    if (it == "!" || it == "~")
        return " "
    if (it == "fma" && after ~ /^\([^-]/)
        return "-fma"
    if (it ~ /^[0-9]+$/)
        return it == "0" ? "1" : it + 1
    if (it ~ /^[0-9].*[.p].*f?$/ || it ~ /^[0-9]+f$/)
        return it ~ /^0\.0f?$/ ? "1.0f" : it ~ /^1\.0f?$/ ? "2.0f" : "(0.5f * " it ")"
    if (it in swap)
        return swap[it]
    return ""
}

function offer(at, it, to,    line) {
    if (to == "-fma") {
        it = "fma("; to = "fma(-"
    }
    line = substr($0, 1, at - 1) (to == " " ? "" : to) substr($0, at + length(it))
    shown = line
    gsub(/^ +| *\\?$/, "", shown)
    if (shown in is_known) {
        delete is_known[shown]
        is_met[shown] = 1
    }
    if (!(shown in is_met))
        found[count++] = FNR "\t" at "\t" it "\t" (to == " " ? "nothing" : to) "\t" line
}

{
    is_continued = was_continued
    was_continued = /\\$/
    at = 1
    if (!is_continued)
        is_skipped = 0
    if (!is_comment && !is_continued && /^#/) {
        # What a macro stands for begins behind its name and parameters.
        if (match($0, /^#define [A-Za-z_0-9]+(\([^)]*\))?/))
            at = RLENGTH + 1
        else
            is_skipped = 1
    }
    if (is_skipped || /__attribute__|_Pragma/)
        next
    while (at <= length($0)) {
        rest = substr($0, at)
        if (is_comment) {
            end = index(rest, "*/")
            if (!end)
                next
            is_comment = 0
            at += end + 1
            continue
        }
        if (substr(rest, 1, 2) == "/*") {
            is_comment = 1
            at += 2
            continue
        }
        length_ = token(rest)
        it = substr(rest, 1, length_)
        to = instead(it, substr($0, 1, at - 1), substr(rest, length_ + 1))
        if (to != "")
            offer(at, it, to)
        at += length_
    }
}

# A generator of its own: awk's differ.
function below(n) {
    seed = (seed * 16807) % 2147483647
    return seed % n
}

END {
    for (shown in is_known) {
        print "stale: " name ": " shown >"/dev/stderr"
        status = 1
    }
    seed = seed % 2147483646 + 1
    for (i = 0; i < 10; ++i)
        below(1)
    for (i = 0; i < count && (most == 0 || i < most); ++i) {
        j = i + below(count - i)
        one = found[j]; found[j] = found[i]
        print one
    }
    exit status
}
