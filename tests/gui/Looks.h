// Looks.h - faults of a window's looks that can be judged: contrast, cut text, overlapping widgets, an order of Tab
// against the order of reading.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QColor>
#include <QImage>
#include <QStringList>
#include <QWidget>
#include <string>
#include <vector>

#include "app/gui/theme/Theme.h"

namespace tacto::test {

/// WCAG 2: 1 to 21.
[[nodiscard]] double contrast(const QColor& a, const QColor& b);
/// How many pixels of the picture have exactly this colour.
[[nodiscard]] int pixelsOf(const QImage& picture, const QColor& colour);

/// Visible labels, buttons, choices of boxes, tabs and titles of columns without room for their text, each with its
/// text. A label that elides by design is left out, unless it has no extent at all.
[[nodiscard]] QStringList cutTexts(const QWidget& in);
/// Visible enabled texts with a contrast below 4.5:1, by the colours of their palettes.
[[nodiscard]] QStringList paleTexts(const QWidget& in);
/// Pairs of visible widgets that lie over each other though a layout places them.
[[nodiscard]] QStringList overlaps(const QWidget& in);
/// All of these and those of HeightLooks.h, PlotLooks.h and RoomLooks.h, a line each; empty where the widget looks
/// right.
[[nodiscard]] std::string faultsOf(const QWidget& in);

/// Places do not depend on colours: in a local run each theme is judged, and each size, but not each pair of them; in
/// CI, and where pictures are kept, all. A change of theme takes a quarter of a second in the whole window.
[[nodiscard]] bool everyPairIsJudged();
/// The present theme, then the other; or the other, then the present, which at 200 % may do.
[[nodiscard]] std::vector<gui::Theme> bothThemes();
[[nodiscard]] std::vector<gui::Theme> themesAt(int percent);
/// The sizes in which `theme` is judged: in the dark one the first may do.
[[nodiscard]] std::vector<QSize> sizesIn(gui::Theme theme, std::vector<QSize> sizes);

/// A size for each size of text; an invalid one leaves the widget as large as it is.
struct LookedAtSizes {
    QSize at100, at200;
};
/// Looks at the shown widget in both themes, with text at 100 and at 200 % (themesAt()): it has no faults, and there is
/// a picture of each (NAME-light-100 …, see shot()). Theme and size are then as they were, the text at 100 %.
/// `frame`: what is resized and pictured, where that is more than what is judged.
void looksRight(QWidget& widget, const QString& name, const LookedAtSizes& sizes = {}, QWidget* frame = nullptr);

/// "QPushButton armButton "Arm"": its class, its name, and its name for those who do not see it, or else its text.
[[nodiscard]] std::string widgetName(const QWidget& widget);
/// Steps of Tab against the direction of reading, a line each: up within a column, back within a row, or up and back.
[[nodiscard]] std::string stepsBack(const std::vector<const QWidget*>& order);

}  // namespace tacto::test
