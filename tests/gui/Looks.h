// Looks.h - finds visible faults of a window: poor contrast, text cut off, overlapping widgets, and a tab order that
// differs from the reading order.
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

/// Contrast ratio by WCAG 2, from 1 to 21.
[[nodiscard]] double contrast(const QColor& a, const QColor& b);
/// Number of pixels in the picture with exactly this colour.
[[nodiscard]] int pixelsOf(const QImage& picture, const QColor& colour);

/// Visible labels, buttons, box entries, tabs and column titles without room for their text, each with this text.
/// Ignores labels that are shortened by design, unless they have no size at all.
[[nodiscard]] QStringList cutTexts(const QWidget& in);
/// Visible enabled texts with a contrast below 4.5:1, calculated from the colours of their palettes.
[[nodiscard]] QStringList paleTexts(const QWidget& in);
/// Pairs of visible widgets that overlap although a layout places them.
[[nodiscard]] QStringList overlaps(const QWidget& in);
/// All faults found here and in HeightLooks.h, PlotLooks.h and RoomLooks.h, one per line; empty if there are none.
[[nodiscard]] std::string faultsOf(const QWidget& in);

/// Places do not depend on colours. So a local run tests each theme and each size, but not every pair; in CI, or if
/// pictures are kept, it tests all pairs. A change of theme takes 0.25 s in the whole window.
[[nodiscard]] bool everyPairIsJudged();
/// bothThemes(): the present theme, then the other. themesAt(): the other first; at 200 % perhaps only the present.
[[nodiscard]] std::vector<gui::Theme> bothThemes();
[[nodiscard]] std::vector<gui::Theme> themesAt(int percent);
/// The sizes in which `theme` is tested; for the dark theme the first alone may be enough.
[[nodiscard]] std::vector<QSize> sizesIn(gui::Theme theme, std::vector<QSize> sizes);

/// The widget's size for each text size; an invalid size leaves the widget as it is.
struct LookedAtSizes {
    QSize at100, at200;
};
/// Tests the shown widget in both themes, with text at 100 and at 200 % (themesAt()): expects no faults, and takes a
/// picture of each (NAME-light-100 …, see shot()). Then restores theme and size, with text at 100 %. `frame`: the
/// widget to resize and photograph, if it is larger than the tested one.
void looksRight(QWidget& widget, const QString& name, const LookedAtSizes& sizes = {}, QWidget* frame = nullptr);

/// Returns "QPushButton armButton "Arm"": class, object name, and the name for screen readers or else the text.
[[nodiscard]] std::string widgetName(const QWidget& widget);
/// Returns the steps of Tab against the reading direction, one per line: up in a column, back in a row, or both.
[[nodiscard]] std::string stepsBack(const std::vector<const QWidget*>& order);

}  // namespace tacto::test
