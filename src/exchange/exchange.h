/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Files in and out by the ending of their name: the native sculpture file both ways, meshes out; and what
 *          `glaise info` says about a native file.
 * Is not:  The formats (stl.h, ply.h, obj.h, inventor.h; the native one is history/checkpoint.h); pictures (picture.h);
 *          the opening, syncing and renaming of a file (platform/storage, joined in wiring).
 * Shape:   ending    holds                                            read back here
 *          .glaise   the whole field: potentials, colours, step       yes
 *          .stl      facets                                           no
 *          .ply      welded mesh, normals, colours with alpha         no
 *          .obj      welded mesh, normals, colours                    no
 *          .iv       welded mesh, normals, colours with alpha         no
 *          Upper and lower case are alike. The name before the ending becomes the piece's name inside the file.
 * Units:   millimetres in files.
 * Owner:   nothing is kept.
 * Errors:  an exchange_outcome: the status, and a text for the person that is empty after STATUS_OK. Where reading
 *          stops, the text is "offset N: expected ..."; the caller, who knows it, puts the file's name before it.
 *          An unknown ending, and a mesh of an empty sculpture, are STATUS_BAD_PARAMETER before the first byte. The
 *          native file of an empty sculpture is written: it holds a step, and can be sculpted on.
 * Cost:    exchange_write makes a surface and waits for the sink: seconds for a large piece. The frame path takes a
 *          still and has it run elsewhere (station/errand.h).
 * Source:  000 section 2.
 */
#ifndef GLAISE_EXCHANGE_EXCHANGE_H
#define GLAISE_EXCHANGE_EXCHANGE_H

#include "exchange/mesh_file.h"
#include "sculpture/still.h"

#include <functional>
#include <string>
#include <string_view>

enum exchange_format {
    EXCHANGE_UNKNOWN,
    EXCHANGE_GLAISE,
    EXCHANGE_STL,
    EXCHANGE_PLY,
    EXCHANGE_OBJ,
    EXCHANGE_INVENTOR,
};

struct [[nodiscard]] exchange_outcome {
    status state = STATUS_OK;
    std::string text; /* why not, or (exchange_info) what was asked for */
};

/* file_name: a path, a name, or the ending alone (".stl"). */
exchange_format exchange_format_of(std::string_view file_name);
/* ".glaise .stl .ply .obj .iv" */
std::string exchange_endings();

/* progress, where given, hears how far it is, 0..1, on the caller's thread. */
exchange_outcome exchange_write(still &s, std::string_view file_name, checkpoint_sink sink, void *self,
                                const std::function<void(double)> &progress = {});
/* The same for a mesh taken earlier; .glaise needs the field and is refused. */
exchange_outcome exchange_write_mesh(const mesh &m, double step_mm, std::string_view file_name, checkpoint_sink sink,
                                     void *self);
/* Native file into s, whole as one stroke or not at all. */
exchange_outcome exchange_read(sculpture &s, checkpoint_source source, void *self);
/* Facts about a native file, one a line: version, step, bricks, corners, box, digest. Reads the whole file, so that a
   damaged one is found out. */
exchange_outcome exchange_info(checkpoint_source source, void *self);

#endif
