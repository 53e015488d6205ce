// LimitMatrixView.h - table of limits and loads. Limits closest to being reached come first; each cell shows the share
// of the limit used on that load, uncertainty included, by colour, shape and number. Cells not evaluated are hatched.
// Choosing a cell shows its tracing.
#pragma once

#include <QTableWidget>
#include <QWidget>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/gui/theme/PlotPicture.h"
#include "app/report/MatrixBlock.h"

class QPainter;

namespace tacto::gui {

/// Paints a cell's background and hatch, or a verdict's shape centred in `place` ("–" if nothing is judged).
void paintCellGround(QPainter& painter, const QRect& cell, const QString& verdict, bool isNear);
void paintCellShape(QPainter& painter, const QRect& place, const QString& verdict, bool isNear, int size);

class LimitMatrixView final : public QTableWidget {
    Q_OBJECT
public:
    explicit LimitMatrixView(QWidget* parent = nullptr);
    /// `matrix`: as from toJson(LimitMatrix); any other value empties the table.
    void show(const nlohmann::json& matrix);
    [[nodiscard]] bool empty() const { return rowCount() == 0; }
    /// Returns a picture of all limits, including those scrolled out of sight.
    [[nodiscard]] Still picture(PictureCaption caption) const;
    /// Returns the height of the header and this number of limits.
    [[nodiscard]] int heightOf(int rows) const;
    /// True: the rows share the full height; false: the view is only as high as they need.
    void setFillsHeight(bool fills);
    static constexpr int kHinted = 6;  ///< most rows in the size hint, to keep the page inside its window
    [[nodiscard]] QSize sizeHint() const override { return {QTableWidget::sizeHint().width(), heightOf(kHinted)}; }

signals:
    /// A load's cell was chosen by mouse or arrow key. `load` as in the results ("500 ohm"), `unit` of the limit.
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
    std::vector<QString> loads_;     // the loads as displayed
    std::vector<QString> loadKeys_;  // the loads as named in the results
    QStringList headings_;           // the column headings, each in one line
};

// The legend for the limits and loads: each type of cell with its shape and words.

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
