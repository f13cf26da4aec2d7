/* Which bodies a ray is inside of: a stack of media, so that leaving one body inside of another
 * leads back into that. It is kept in one integer, the innermost medium in the lowest bits; what
 * does not go in is forgotten from the outermost on. */

/* The innermost, 0 in the open. */
INLINE int medium_of(const rt_nesting n, ulong inside)
{
    return (int)(inside & ((1ul << n.bits) - 1));
}

INLINE ulong entered(const rt_nesting n, ulong inside, int medium)
{
    const ulong places = n.ones * ((1ul << n.bits) - 1);
    return (inside << n.bits | (ulong)medium) & places;
}

/* Without the innermost body of that medium, which need not be the innermost of all where bodies
 * overlap; the same where the ray is in none. */
INLINE ulong left_body(const rt_nesting n, ulong inside, int medium)
{
    const ulong high = n.ones << (n.bits - 1), rest = high - n.ones;
    /* The highest bit of each place that is zero after this, and of no other. */
    const ulong other = inside ^ n.ones * (ulong)medium;
    const ulong here = ~(((other & rest) + rest) | other) & high;
    if (here == 0)
        return inside;
    const ulong below = ((here & (~here + 1)) >> (n.bits - 1)) - 1;
    return (inside & below) | (inside >> n.bits & ~below);
}
