// ClearPlace.h - where a box over a plot hides least of what is drawn there.
//
// Thread-safety: pure functions.
#pragma once

#include <QRectF>
#include <vector>

namespace tacto::gui {

/// How much of `drawn` lies under `box`, in square pixels.
[[nodiscard]] double hiddenBy(const QRectF& box, const std::vector<QRectF>& drawn);

/// `box`, moved up or down inside `within` to where it lies over least of `drawn`: as near to where it stands as that
/// allows, for a box that jumps cannot be read.
[[nodiscard]] QRectF atClearHeight(const QRectF& box, const QRectF& within, const std::vector<QRectF>& drawn);

}  // namespace tacto::gui
