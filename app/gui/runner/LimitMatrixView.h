// LimitMatrixView.h - limits x loads: every limit once, the nearest to its limit first, and on each load how much of it
// is used, uncertainty included. A cell has colour, shape and share; what was not evaluated is hatched. A chosen cell
// drives the tracing.
#pragma once

#include <QTableWidget>
#include <QWidget>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/gui/theme/PlotPicture.h"
#include "app/report/MatrixBlock.h"

class QPainter;

namespace tacto::gui {

/// A cell's fill and hatch, and the shape of its verdict in the middle of `place`; "–" where nothing is judged.
void paintCellGround(QPainter& painter, const QRect& cell, const QString& verdict, bool isNear);
void paintCellShape(QPainter& painter, const QRect& place, const QString& verdict, bool isNear, int size);

class LimitMatrixView final : public QTableWidget {
    Q_OBJECT
public:
    explicit LimitMatrixView(QWidget* parent = nullptr);
    /// `matrix` as toJson(LimitMatrix); anything else empties it.
    void show(const nlohmann::json& matrix);
    [[nodiscard]] bool empty() const { return rowCount() == 0; }
    /// Its picture shows all limits, those too that are scrolled out of sight.
    [[nodiscard]] Still picture(PictureCaption caption) const;
    /// The height of the header and of that many limits.
    [[nodiscard]] int heightOf(int rows) const;
    /// The rows share all the height that is given; else the view is no higher than they need.
    void setFillsHeight(bool fills);
    static constexpr int kHinted = 6;  ///< a page that hints at more would be higher than its window
    [[nodiscard]] QSize sizeHint() const override { return {QTableWidget::sizeHint().width(), heightOf(kHinted)}; }

signals:
    /// A cell of a load was chosen by mouse or arrow key. `load` as the results name it ("500 ohm"), `unit` the
    /// limit's.
    void chosen(const QString& limit, const QString& load, const QString& unit);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void addLine(int row, const MatrixBlock::Row& line);
    void fitRows();
    void fitColumns();
    void choose(int row, int column);
    nlohmann::json shown_;
    bool fillsHeight_ = false;
    std::vector<QString> loads_;     // the loads as people write them
    std::vector<QString> loadKeys_;  // the loads as the results name them
    QStringList headings_;           // the columns' headings, each in one line
};

// The legend beside the limits and loads: each kind of cell with its shape and words.

class CellLegend final : public QWidget {
    Q_OBJECT
public:
    explicit CellLegend(QWidget* parent);
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    struct Kind {
        QString verdict;  ///< empty: not judged
        bool isNear;
        QString words;
    };
    std::vector<Kind> kinds_;
};

}  // namespace tacto::gui
