/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_scene.h"

#include "clay/capacity.h"

bench_scene::bench_scene(const std::string &which) : name(which)
{
    rig = std::make_unique<bench_rig>(CAPACITY_BRICKS, 8000000);
    for (const bench_object_dab &d : bench_object_million(is_large() ? 2.72 : 1)) {
        tool_counts counts;
        rig->field(d, &counts);
        dirt_clear(&rig->field_clay.dirty);
    }
    bench_rig_demand(clay_init(&pristine, CAPACITY_BRICKS) == STATUS_OK &&
                         clay_copy(&pristine, &rig->field_clay) == STATUS_OK,
                     "no room for a second " + name);
    surface_counts counts;
    bench_rig_demand(surface_rebuild(&rig->skin, &rig->field_clay, &counts) == STATUS_OK, "surface_rebuild");
    vdb = vdb_peer_open();
    if (vdb)
        vdb->load(pristine);
}

bench_scene::~bench_scene() { clay_finish(&pristine); }

void bench_scene::restore()
{
    clay_clear(&rig->field_clay);
    bench_rig_demand(clay_copy(&rig->field_clay, &pristine) == STATUS_OK, "clay_copy");
    bench_rig_demand(surface_rebuild(&rig->skin, &rig->field_clay, nullptr) == STATUS_OK, "surface_rebuild");
    dirt_clear(&rig->field_clay.dirty);
    if (vdb)
        vdb->restore();
}
