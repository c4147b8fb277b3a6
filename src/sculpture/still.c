/* SPDX-License-Identifier: Apache-2.0 */
#include "sculpture/still.h"

status still_begin(still *s, sculpture *of)
{
    status outcome = freeze_begin(&s->field, &of->clay);
    if (outcome != STATUS_OK)
        return outcome;
    s->step_mm = of->step_mm;
    s->dab = of->dab;
    return STATUS_OK;
}

void still_end(still *s) { freeze_end(&s->field); }

status still_write(still *s, checkpoint_sink sink, void *self)
{
    const checkpoint_facts facts = {
        .step_mm = s->step_mm, .dab = s->dab, .digest = clay_digest(&s->field.still)};
    return checkpoint_write(&s->field.still, &facts, sink, self);
}

status still_mesh(const still *s, mesh *mesh_out)
{
    surface skin;
    const clay *c = &s->field.still;
    status outcome = surface_init(&skin, (uint32_t)((uint64_t)c->bricks.limit * CAPACITY_PATCHES / CAPACITY_BRICKS));
    if (outcome != STATUS_OK)
        return outcome;
    outcome = surface_rebuild(&skin, c, NULL);
    if (outcome == STATUS_OK)
        outcome = mesh_init(mesh_out, &skin);
    surface_finish(&skin);
    return outcome;
}
