#include "app/gui/scope/screen/ClearPlace.h"

#include <algorithm>
#include <iterator>

namespace tacto::gui {

namespace {

constexpr double kBesideTheBox = 4;  // pixels: what runs along its side is not hidden by it

}  // namespace

double hiddenBy(const QRectF& whole, const std::vector<QRectF>& drawn) {
    const auto box = whole.adjusted(kBesideTheBox, 0, -kBesideTheBox, 0);
    double area = 0;
    for (const auto& its : drawn) {
        const auto shared = its.intersected(box);
        if (!shared.isEmpty()) area += shared.width() * shared.height();
    }
    return area;
}

QRectF atClearHeight(const QRectF& box, const QRectF& within, const std::vector<QRectF>& drawn) {
    constexpr double kStep = 8;           // pixels
    constexpr double kClearlyLess = 0.8;  // share of what is hidden now: noise moves no box
    std::vector<QRectF> below;
    std::copy_if(drawn.begin(), drawn.end(), std::back_inserter(below),
                 [&](const QRectF& its) { return its.right() > box.left() && its.left() < box.right(); });
    QRectF best = box;
    double least = hiddenBy(box, below);
    const double farthest = within.height();
    for (double away = kStep; least > 0 && away < farthest; away += kStep) {
        for (const double top : {box.top() - away, box.top() + away}) {
            if (top < within.top() || top + box.height() > within.bottom()) continue;
            QRectF moved = box;
            moved.moveTop(top);
            const double its = hiddenBy(moved, below);
            if (!(its < kClearlyLess * least)) continue;
            least = its;
            best = moved;
        }
    }
    return best;
}

}  // namespace tacto::gui
