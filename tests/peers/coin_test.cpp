/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   Coin, the Open Inventor of today, reads our .iv and sees the piece that was written: every corner's place,
 *         normal, colour and opacity, closed, facing outwards, with the same volume.
 * Method: SoDB reads the file, SoCallbackAction hands over triangles as a viewer would get them.
 */
#include "peer_judge.h"

#include <gtest/gtest.h>

#ifdef PEERS_COIN

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>

namespace {

/* Coin is started once and finished once: it cannot be started again. */
class coin : public testing::Test {
protected:
    static void SetUpTestSuite() { SoDB::init(); }
    static void TearDownTestSuite() { SoDB::finish(); }
};

void add_corner(peer_judge_corners &seen, SoCallbackAction &action, const SoPrimitiveVertex &v)
{
    const SbVec3f at = v.getPoint(), normal = v.getNormal();
    SbColor ambient, diffuse, specular, emission;
    float shininess = 0, transparency = 0;
    action.getMaterial(ambient, diffuse, specular, emission, shininess, transparency, v.getMaterialIndex());
    seen.at.push_back({at[0], at[1], at[2]});
    seen.normal.push_back({normal[0], normal[1], normal[2]});
    seen.colour.push_back({diffuse[0], diffuse[1], diffuse[2], 1.0 - static_cast<double>(transparency)});
}

void take_triangle(void *self, SoCallbackAction *action, const SoPrimitiveVertex *a, const SoPrimitiveVertex *b,
                   const SoPrimitiveVertex *c)
{
    peer_judge_corners &seen = *static_cast<peer_judge_corners *>(self);
    EXPECT_EQ(action->getVertexOrdering(), SoShapeHints::COUNTERCLOCKWISE);
    EXPECT_EQ(action->getShapeType(), SoShapeHints::SOLID);
    for (const SoPrimitiveVertex *v : {a, b, c})
        add_corner(seen, *action, *v);
}

peer_judge_corners seen_by_coin(const std::string &path)
{
    peer_judge_corners seen;
    seen.has_alpha = true;
    SoInput in;
    if (!in.openFile(path.c_str())) {
        ADD_FAILURE() << path << ": cannot be opened";
        return seen;
    }
    SoSeparator *root = SoDB::readAll(&in);
    if (root == nullptr) {
        ADD_FAILURE() << path << ": Coin refuses it";
        return seen;
    }
    root->ref();
    SoCallbackAction action;
    action.addTriangleCallback(SoShape::getClassTypeId(), take_triangle, &seen);
    action.apply(root);
    root->unref();
    return seen;
}

TEST_F(coin, sees_both_pieces)
{
    for (const char *kind : {"blob", "torus"}) {
        const clay_piece piece(kind);
        const clay_piece_file file(piece, ".iv");
        peer_judge("Coin .iv", piece, seen_by_coin(file.path));
    }
}

TEST_F(coin, hole_is_noticed)
{
    const clay_piece piece("torus");
    const clay_piece_file file(piece, ".iv", 1);
    const peer_judge_corners seen = seen_by_coin(file.path);
    EXPECT_EQ(seen.at.size(), (size_t{piece.surface.triangle_count} - 1) * 3);
    EXPECT_FALSE(peer_judge_closed(seen));
}

} // namespace

#else

TEST(coin, sees_both_pieces)
{
    GTEST_SKIP() << "Coin was not found when this was configured (package libcoin-dev)";
}

#endif
