/* PLY (Greg Turk, "The PLY Polygon File Format", 1994): a header that declares elements and their
 * properties, then one row after another. Vertices, faces and triangle strips make the mesh; all
 * other elements and properties are passed over by their declared sizes. */
#include "mesh/build.h"
#include "mesh/ply_data.h"
#include "mesh/ply_header.h"

bool rt_mesh_read_ply(rt_mesh *mesh, const rt_mesh_source *source, rt_status *status)
{
    rt_ply_header header = {0};
    rt_text text = rt_mesh_text(source, status);
    const bool good =
        rt_ply_read_header(&header, &text) && rt_ply_read_data(mesh, source, &header, &text);
    rt_ply_clear_header(&header);
    return good;
}
