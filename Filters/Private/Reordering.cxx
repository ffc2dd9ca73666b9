// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Reordering.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <numeric>

namespace spectralwatermark
{

namespace
{

vtkSmartPointer<vtkIdList> IdList(const std::vector<vtkIdType>& ids)
{
  auto list = vtkSmartPointer<vtkIdList>::New();
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->begin());
  return list;
}

// Copies the tuples with these ids, in this order.
void CopyAttributes(vtkDataSetAttributes* from, vtkDataSetAttributes* to,
  const std::vector<vtkIdType>& ids)
{
  const auto source = IdList(ids);
  vtkNew<vtkIdList> target;
  target->SetNumberOfIds(source->GetNumberOfIds());
  std::iota(target->begin(), target->end(), vtkIdType{ 0 });
  to->CopyAllOn();
  to->CopyAllocate(from, source->GetNumberOfIds());
  to->CopyData(from, source, target);
}

// Copies cells of one kind in this order, without those that have lost a point, and appends the ids
// of the copied ones to `kept`.
vtkSmartPointer<vtkCellArray> CopyCells(vtkCellArray* cells, const std::vector<vtkIdType>& order,
  const std::vector<vtkIdType>& newPoint, vtkIdType firstId, std::vector<vtkIdType>& kept)
{
  auto copied = vtkSmartPointer<vtkCellArray>::New();
  vtkNew<vtkIdList> corners;
  for (const vtkIdType cell : order)
  {
    cells->GetCellAtId(cell, corners);
    std::transform(corners->begin(), corners->end(), corners->begin(),
      [&newPoint](vtkIdType point) { return newPoint[point]; });
    if (std::find(corners->begin(), corners->end(), -1) == corners->end())
    {
      copied->InsertNextCell(corners);
      kept.push_back(firstId + cell);
    }
  }
  return copied;
}

} // namespace

std::vector<vtkIdType> IdentityOrder(vtkIdType count)
{
  std::vector<vtkIdType> order(count);
  std::iota(order.begin(), order.end(), vtkIdType{ 0 });
  return order;
}

vtkSmartPointer<vtkPolyData> ExtractPoints(vtkPolyData* input, const std::vector<vtkIdType>& points,
  const std::vector<vtkIdType>& polygons)
{
  std::vector<vtkIdType> newPoint(input->GetNumberOfPoints(), -1);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    newPoint[points[k]] = static_cast<vtkIdType>(k);
  }
  auto output = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> moved;
  moved->SetDataType(input->GetPoints()->GetDataType());
  moved->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  input->GetPoints()->GetData()->GetTuples(IdList(points), moved->GetData());
  output->SetPoints(moved);
  CopyAttributes(input->GetPointData(), output->GetPointData(), points);

  // Cell ids run through vertices, lines, polygons and strips, in this order.
  std::vector<vtkIdType> kept;
  vtkIdType first = 0;
  const auto copy = [&](vtkCellArray* cells, const std::vector<vtkIdType>& order)
  {
    auto copied = CopyCells(cells, order, newPoint, first, kept);
    first += cells->GetNumberOfCells();
    return copied;
  };
  output->SetVerts(copy(input->GetVerts(), IdentityOrder(input->GetNumberOfVerts())));
  output->SetLines(copy(input->GetLines(), IdentityOrder(input->GetNumberOfLines())));
  output->SetPolys(copy(input->GetPolys(), polygons));
  output->SetStrips(copy(input->GetStrips(), IdentityOrder(input->GetNumberOfStrips())));
  CopyAttributes(input->GetCellData(), output->GetCellData(), kept);
  output->GetFieldData()->PassData(input->GetFieldData());
  return output;
}

} // namespace spectralwatermark
