#include "flying_edges.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkVersion.h>

struct FlyingEdges::Vtk {
  float isovalue = 0;
  bool normals = true;
  vtkNew<vtkImageData> image;
  vtkSmartPointer<vtkFlyingEdges3D> filter;
};

FlyingEdges::FlyingEdges(std::vector<float>& values, const std::array<std::int64_t, 3>& dims, float isovalue,
                         bool normals, int threads)
    : vtk_(std::make_unique<Vtk>()) {
  vtkSMPTools::Initialize(threads);
  vtk_->isovalue = isovalue;
  vtk_->normals = normals;
  // Its first axis is the fastest one.
  vtk_->image->SetDimensions(static_cast<int>(dims[2]), static_cast<int>(dims[1]), static_cast<int>(dims[0]));
  const vtkNew<vtkFloatArray> scalars;
  scalars->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);
  vtk_->image->GetPointData()->SetScalars(scalars);
}

FlyingEdges::~FlyingEdges() = default;

void FlyingEdges::run() {
  if (vtk_->filter == nullptr) {
    vtk_->filter = vtkSmartPointer<vtkFlyingEdges3D>::New();
    vtk_->filter->SetInputData(vtk_->image);
    vtk_->filter->SetValue(0, vtk_->isovalue);
    vtk_->filter->SetComputeNormals(vtk_->normals);
    vtk_->filter->ComputeGradientsOff();
    vtk_->filter->ComputeScalarsOff();
  }
  vtk_->filter->Modified();
  vtk_->filter->Update();
}

void FlyingEdges::release() {
  vtk_->filter = nullptr;
}

std::int64_t FlyingEdges::vertices() const {
  return vtk_->filter->GetOutput()->GetNumberOfPoints();
}

std::int64_t FlyingEdges::triangles() const {
  return vtk_->filter->GetOutput()->GetNumberOfPolys();
}

std::string FlyingEdges::version() {
  return std::string(vtkVersion::GetVTKVersion()) + ", " + vtkSMPTools::GetBackend();
}
