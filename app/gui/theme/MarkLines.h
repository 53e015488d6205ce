// MarkLines.h - the operator's marks in plots over time: a dashed line at the marked time through each axis rect, and
// the word at the top of the first rect.
#pragma once

#include <qcustomplot.h>
#include <string>
#include <vector>

namespace tacto::gui {

/// A moment that the operator marked, on the plot's time axis.
struct PlotMark {
    double t_s = 0;
    std::string word;
};

class MarkLines {
public:
    /// The plot owns the lines and words made here.
    explicit MarkLines(QCustomPlot& plot) : plot_(plot) {}
    /// Draws the marks that lie within the time range of `rects`.
    void draw(const std::vector<PlotMark>& marks, const std::vector<QCPAxisRect*>& rects);
    /// Takes the colours of the current theme.
    void colour();
    /// The words drawn at present.
    [[nodiscard]] QStringList words() const;

private:
    struct Drawn {
        std::vector<QCPItemStraightLine*> lines;  ///< one for each axis rect
        QCPItemText* word = nullptr;
    };
    void make(Drawn& drawn, std::size_t lines);
    void colour(const Drawn& drawn) const;
    QCustomPlot& plot_;
    std::vector<Drawn> drawn_;  // reused for the next marks
};

}  // namespace tacto::gui
