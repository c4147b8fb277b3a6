/* SPDX-License-Identifier: Apache-2.0 */
#include "vtk_peer.h"

#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>

#include <cstring>

namespace {

class peer final : public vtk_peer {
public:
    explicit peer(const clay &from)
    {
        vtkSMPTools::Initialize(1);
        const box stored = clay_box(&from);
        const key min = key_add(stored.min, -1, -1, -1), max = key_add(stored.max, 1, 1, 1);
        /* VTK's first axis runs fastest: k. */
        const int size[3] = {max.k - min.k + 1, max.j - min.j + 1, max.i - min.i + 1};
        const vtkIdType corners = vtkIdType{1} * size[0] * size[1] * size[2];
        image->SetDimensions(size);
        potential->SetName("potential");
        potential->SetNumberOfValues(corners);
        std::memset(potential->GetPointer(0), 0, static_cast<size_t>(corners) * sizeof(float));
        rgba->SetName("rgba");
        rgba->SetNumberOfComponents(4);
        rgba->SetNumberOfTuples(corners);
        std::memset(rgba->GetPointer(0), 0, static_cast<size_t>(corners) * sizeof(uint32_t));
        avl_walk w;
        key at;
        uint32_t id;
        for (bool more = avl_first(&w, &from.tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
            const brick_page *page = clay_brick(&from, id)->page;
            for (int n = 0; n < BRICK_CORNERS; n++) {
                if (!(page->potential[n] > POTENTIAL_MIN))
                    continue;
                const key c = key_add(key_of_brick(at), n >> 6, n >> 3 & 7, n & 7);
                const vtkIdType to =
                    (vtkIdType{c.i - min.i} * size[1] + (c.j - min.j)) * size[0] + (c.k - min.k);
                potential->SetValue(to, page->potential[n]);
                std::memcpy(rgba->GetPointer(4 * to), &page->rgba[n], sizeof page->rgba[n]);
            }
        }
        image->GetPointData()->SetScalars(potential);
    }

    uint64_t whole(bool colours) override
    {
        if (colours)
            image->GetPointData()->AddArray(rgba);
        else
            image->GetPointData()->RemoveArray("rgba");
        vtkNew<vtkFlyingEdges3D> edges;
        edges->SetInputData(image);
        edges->SetValue(0, static_cast<double>(POTENTIAL_ISO));
        edges->SetComputeNormals(true);
        edges->SetComputeScalars(false);
        edges->SetInterpolateAttributes(colours);
        edges->Update();
        return static_cast<uint64_t>(edges->GetOutput()->GetNumberOfPolys());
    }

private:
    vtkNew<vtkImageData> image;
    vtkNew<vtkFloatArray> potential;
    vtkNew<vtkUnsignedCharArray> rgba;
};

} // namespace

std::unique_ptr<vtk_peer> vtk_peer_open(const clay &from) { return std::make_unique<peer>(from); }
std::string vtk_peer_version() { return vtkVersion::GetVTKVersion(); }
