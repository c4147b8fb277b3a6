/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   assimp, through which game and animation programs read files, sees in STL, PLY and OBJ the piece that was
 *         written: every corner's place, normal and colour, closed, with the same volume.
 * Method: its C interface reads the files without any clean-up step; what it hands over is compared corner by corner.
 */
#include "peer_judge.h"

#include <gtest/gtest.h>

#ifdef PEERS_ASSIMP

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace {

peer_judge_corners corners_of(const aiMesh &m, bool with_normals, bool with_colours)
{
    peer_judge_corners seen;
    for (unsigned f = 0; f < m.mNumFaces; f++)
        for (unsigned c = 0; c < m.mFaces[f].mNumIndices; c++) {
            const unsigned v = m.mFaces[f].mIndices[c];
            seen.at.push_back({m.mVertices[v].x, m.mVertices[v].y, m.mVertices[v].z});
            if (with_normals)
                seen.normal.push_back({m.mNormals[v].x, m.mNormals[v].y, m.mNormals[v].z});
            if (with_colours)
                seen.colour.push_back({m.mColors[0][v].r, m.mColors[0][v].g, m.mColors[0][v].b, m.mColors[0][v].a});
        }
    return seen;
}

peer_judge_corners seen_by_assimp(const std::string &path, const std::string &ending)
{
    const aiScene *scene = aiImportFile(path.c_str(), aiProcess_ValidateDataStructure);
    if (scene == nullptr) {
        ADD_FAILURE() << path << ": " << aiGetErrorString();
        return {};
    }
    EXPECT_EQ(scene->mNumMeshes, 1u);
    const aiMesh &m = *scene->mMeshes[0];
    EXPECT_EQ(m.mPrimitiveTypes & (aiPrimitiveType_POINT | aiPrimitiveType_LINE | aiPrimitiveType_POLYGON), 0u);
    EXPECT_NE(m.mNormals, nullptr);
    const bool with_colours = ending != ".stl";
    EXPECT_EQ(m.mColors[0] != nullptr, with_colours);
    /* STL has facet normals: assimp copies them to the corners, where the mesh has others. */
    peer_judge_corners seen =
        corners_of(m, m.mNormals != nullptr && ending != ".stl", m.mColors[0] != nullptr && with_colours);
    seen.has_alpha = ending == ".ply";
    aiReleaseImport(scene);
    return seen;
}

class assimp : public testing::TestWithParam<const char *> {};

TEST_P(assimp, sees_both_pieces)
{
    for (const char *kind : {"blob", "torus"}) {
        const clay_piece piece(kind);
        const clay_piece_file file(piece, GetParam());
        const std::string peer = std::string("assimp ") + GetParam();
        peer_judge(peer.c_str(), piece, seen_by_assimp(file.path, GetParam()));
    }
}

TEST_P(assimp, hole_is_noticed)
{
    const clay_piece piece("torus");
    const clay_piece_file file(piece, GetParam(), 1);
    const peer_judge_corners seen = seen_by_assimp(file.path, GetParam());
    EXPECT_EQ(seen.at.size(), (size_t{piece.surface.triangle_count} - 1) * 3);
    EXPECT_FALSE(peer_judge_closed(seen));
}

std::string name_of_ending(const testing::TestParamInfo<const char *> &info)
{
    return info.param + 1;
}

INSTANTIATE_TEST_SUITE_P(formats, assimp, testing::Values(".stl", ".ply", ".obj"), name_of_ending);

} // namespace

#else

TEST(assimp, sees_both_pieces)
{
    GTEST_SKIP() << "assimp was not found when this was configured (package libassimp-dev)";
}

#endif
