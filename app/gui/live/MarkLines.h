// MarkLines.h - the operator's marks across all strips of the live plots: a dashed line at its moment, the word at the
// top.
//
// Thread-safety: the GUI thread.
#pragma once

#include <deque>
#include <qcustomplot.h>
#include <vector>

#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/Strip.h"

namespace tacto::gui {

class MarkLines {
public:
    /// `strips` outlive this; what is made here is the plot's.
    MarkLines(QCustomPlot& plot, const std::deque<Strip>& strips) : plot_(plot), strips_(strips) {}
    /// Those of `marks` that lie in `time`.
    void draw(const std::vector<LiveMark>& marks, const QCPRange& time);
    /// In the current theme.
    void colour();
    /// The words that are drawn now.
    [[nodiscard]] QStringList words() const;

private:
    struct Drawn {
        std::vector<QCPItemStraightLine*> lines;  ///< one for each strip
        QCPItemText* word = nullptr;
    };
    [[nodiscard]] Drawn make();
    void colour(const Drawn& drawn) const;
    QCustomPlot& plot_;
    const std::deque<Strip>& strips_;
    std::vector<Drawn> drawn_;  // kept for the next marks
};

}  // namespace tacto::gui
