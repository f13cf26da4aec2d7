# Writes spheres.txt: awk -f spheres.awk >spheres.txt
# A sphereflake (Haines, "A Proposal for Standard Graphics Environments", 1987): a sphere bears nine of
# a third of its size, six round its waist and three above, and each of those bears nine again.
function put(x, y, z, r, level)
{
    printf "sphere center %.4f %.4f %.4f radius %.4f material m%d\n", x, y, z, r, level
}

# (ux, uy, uz) is the way up, (ax, ay, az) at right angles to it.
function flake(x, y, z, r, ux, uy, uz, ax, ay, az, level,    bx, by, bz, k, s, c, e, dx, dy, dz, d)
{
    put(x, y, z, r, level)
    if (level == levels)
        return
    bx = uy * az - uz * ay; by = uz * ax - ux * az; bz = ux * ay - uy * ax
    for (k = 0; k < 9; ++k) {
        e = k < 6 ? 0 : cos(pi / 6)                       # sine of the height above the waist
        s = (k < 6 ? k * pi / 3 : pi / 6 + (k - 6) * 2 * pi / 3)
        c = sqrt(1 - e * e) * cos(s); s = sqrt(1 - e * e) * sin(s)
        dx = c * ax + s * bx + e * ux; dy = c * ay + s * by + e * uy; dz = c * az + s * bz + e * uz
        d = r + r / 3
        # The child's own side: what is left of the parent's way up, or of its side at the waist's pole.
        px = ux - e * dx; py = uy - e * dy; pz = uz - e * dz
        n = sqrt(px * px + py * py + pz * pz)
        flake(x + d * dx, y + d * dy, z + d * dz, r / 3, dx, dy, dz, px / n, py / n, pz / n, level + 1)
    }
}

BEGIN {
    pi = 3.14159265358979323846
    levels = 4
    print "# A sphereflake of 7381 spheres that reflect one another; spheres.awk writes this file."
    print "rt 1"
    print "image      width 960 height 720  samples 9"
    print "camera     from 1.5 1.55 5.9  at 0 0.3 0  up 0 1 0  vfov 34"
    print "background 0.75 0.82 0.92  top 0.12 0.2 0.42"
    print "ambient    0.38 0.38 0.42"
    print "light      point  at 4 7 5  color 0.9 0.86 0.8"
    print "light      point  at -6 4 3  color 0.25 0.27 0.34"
    print "shadows    on"
    print "depth      4"
    print ""
    print "material   floor  ka 0.85 0.82 0.78  kd 0.85 0.82 0.78  checker 0.55 0.6 0.7  cell 0.5  reflect 0.12"
    print "triangle   a -40 -1 20  b 40 -1 20   c 40 -1 -80   material floor"
    print "triangle   a -40 -1 20  b 40 -1 -80  c -40 -1 -80  material floor"
    print ""
    print "material   m0  ka 0.1 0.1 0.12   kd 0.15 0.15 0.17   ks 0.8 0.7 0.5  shininess 200  reflect 0.75"
    print "material   m1  ka 0.35 0.22 0.08  kd 0.45 0.28 0.1   ks 0.8 0.7 0.5  shininess 80  reflect 0.45"
    print "material   m2  ka 0.4 0.28 0.1    kd 0.55 0.38 0.12  ks 0.8 0.7 0.5  shininess 60  reflect 0.35"
    print "material   m3  ka 0.45 0.35 0.12  kd 0.62 0.48 0.15  ks 0.7 0.6 0.4  shininess 60  reflect 0.25"
    print "material   m4  ka 0.5 0.42 0.2    kd 0.7 0.56 0.25   ks 0.5 0.5 0.4  shininess 40  reflect 0.15"
    flake(0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0)
}
