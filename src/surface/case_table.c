/* SPDX-License-Identifier: Apache-2.0 */
/*
 *              6 -------3------- 7          corners and, on the lines between them, edges:
 *             /:                /|          0..3 run along x, 4..7 along y, 8..11 along z
 *            6 :               7 |
 *           /  10             /  11         z   y
 *          4 -------2------- 5   |          |  /
 *          |   :             |   |          | /
 *          |   2 . . . 1 . . | . 3          0 --- x
 *          8  /              9  /
 *          | 4               | 5
 *          |/                |/
 *          0 -------0------- 1
 *
 * The four edges along one axis are numbered by their smaller corner's coordinates on the other two axes, the lower of
 * which counts 1 and the higher 2.
 */
#include "surface/case_table.h"

#include <assert.h>
#include <stdbool.h>

enum { FACES = 6, LOOP_MAX = 7, FORBIDDEN = 1 << 20 };

static int edge_axis(int e) { return e >> 2; }

void case_table_edge(int e, int *from_out, int *to_out)
{
    int axis = edge_axis(e), low = axis == 0, high = axis == 2 ? 1 : 2;
    *from_out = (e & 1) << low | (e >> 1 & 1) << high;
    *to_out = *from_out | 1 << axis;
}

static int edge_between(int a, int b)
{
    for (int e = 0; e < CASE_TABLE_EDGES; e++) {
        int from, to;
        case_table_edge(e, &from, &to);
        if ((from == a && to == b) || (from == b && to == a))
            return e;
    }
    assert(!"no such edge");
    return -1;
}

/* Corners of a face in counter-clockwise order seen from outside the cube. Face = axis * 2 + side. */
static void face_corners(int face, int corner_out[4])
{
    int axis = face >> 1, side = face & 1;
    int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
    corner_out[0] = base;
    corner_out[1] = base | (side ? u : v);
    corner_out[2] = base | u | v;
    corner_out[3] = base | (side ? v : u);
}

/* One bit for each of the two faces an edge lies on. */
static int edge_faces(int e)
{
    int from, to, faces = 0;
    case_table_edge(e, &from, &to);
    for (int axis = 0; axis < 3; axis++)
        if (axis != edge_axis(e))
            faces |= 1 << (axis * 2 + (from >> axis & 1));
    return faces;
}

/*
 * The face rule. Going round a face, every run of inside corners is left over one cut edge and was entered over
 * another: one segment joins the two and so cuts the run off. Two runs (an ambiguous face) are cut off one by one: the
 * inside is never joined across a face. Each cut edge is left over on one of its faces and entered over on the other,
 * hence `next` is a permutation of them.
 */
static void contours_trace(int index, int next_out[CASE_TABLE_EDGES])
{
    for (int e = 0; e < CASE_TABLE_EDGES; e++)
        next_out[e] = -1;
    for (int face = 0; face < FACES; face++) {
        int corner[4];
        face_corners(face, corner);
        for (int n = 0; n < 4; n++) {
            bool leaves = (index >> corner[n] & 1) && !(index >> corner[(n + 1) & 3] & 1);
            if (!leaves)
                continue;
            int m = n;
            while (index >> corner[(m + 3) & 3] & 1)
                m = (m + 3) & 3;
            next_out[edge_between(corner[n], corner[(n + 1) & 3])] = edge_between(corner[(m + 3) & 3], corner[m]);
        }
    }
}

/* Squared length of the diagonal between two edges' midpoints, in half steps; FORBIDDEN inside a face, where the cube
   beyond could draw the same diagonal and give it four triangles. */
static int diagonal_cost(int e, int f)
{
    if (edge_faces(e) & edge_faces(f))
        return FORBIDDEN;
    int e_from, e_to, f_from, f_to, sum = 0;
    case_table_edge(e, &e_from, &e_to);
    case_table_edge(f, &f_from, &f_to);
    for (int axis = 0; axis < 3; axis++) {
        int d = (e_from >> axis & 1) + (e_to >> axis & 1) - (f_from >> axis & 1) - (f_to >> axis & 1);
        sum += d * d;
    }
    return sum;
}

static void triangles_emit(case_table *t, int index, const int *loop, int (*apex)[LOOP_MAX], int i, int j)
{
    if (j - i < 2)
        return;
    int m = apex[i][j];
    assert(t->triangles[index] < CASE_TABLE_TRIANGLES_MAX);
    uint8_t *out = &t->edge[index][3 * t->triangles[index]++];
    out[0] = (uint8_t)loop[i];
    out[1] = (uint8_t)loop[m];
    out[2] = (uint8_t)loop[j];
    triangles_emit(t, index, loop, apex, i, m);
    triangles_emit(t, index, loop, apex, m, j);
}

/* Of the triangulations without a forbidden diagonal, one whose diagonals are shortest; the first among equals. */
static void loop_triangulate(case_table *t, int index, const int *loop, int n)
{
    int cost[LOOP_MAX][LOOP_MAX] = {{0}}, apex[LOOP_MAX][LOOP_MAX] = {{0}};
    for (int span = 2; span < n; span++)
        for (int i = 0; i + span < n; i++) {
            int j = i + span, best = 2 * FORBIDDEN;
            for (int m = i + 1; m < j; m++)
                if (cost[i][m] + cost[m][j] < best) {
                    best = cost[i][m] + cost[m][j];
                    apex[i][j] = m;
                }
            bool side = i == 0 && j == n - 1;
            best += side ? 0 : diagonal_cost(loop[i], loop[j]);
            cost[i][j] = best < FORBIDDEN ? best : FORBIDDEN;
        }
    assert(cost[0][n - 1] < FORBIDDEN);
    triangles_emit(t, index, loop, apex, 0, n - 1);
}

void case_table_init(case_table *t)
{
    *t = (case_table){{0}, {{0}}};
    for (int index = 0; index < CASE_TABLE_CASES; index++) {
        int next[CASE_TABLE_EDGES];
        contours_trace(index, next);
        for (int e = 0; e < CASE_TABLE_EDGES; e++) {
            int loop[LOOP_MAX], n = 0;
            for (int at = e; next[at] >= 0;) {
                assert(n < LOOP_MAX);
                loop[n++] = at;
                int after = next[at];
                next[at] = -1;
                at = after;
            }
            /* As traced a loop runs counter-clockwise seen from inside. */
            for (int a = 0, b = n - 1; a < b; a++, b--) {
                int swap = loop[a];
                loop[a] = loop[b];
                loop[b] = swap;
            }
            if (n > 0)
                loop_triangulate(t, index, loop, n);
        }
    }
}
