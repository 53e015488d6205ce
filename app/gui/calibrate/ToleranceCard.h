// ToleranceCard.h - one calibrated quantity as a card: its verdict, how much of its tolerance is used, and at which
// level. A click shows the quantity in the plot.
#pragma once

#include <QAbstractButton>

#include "app/gui/calibrate/CalibrationReadings.h"

namespace tacto::gui {

class ToleranceCard final : public QAbstractButton {
    Q_OBJECT
public:
    explicit ToleranceCard(const QString& title, QWidget* parent = nullptr);
    void show(const CalibrationReadings& of);
    /// How much the card shows: everything in large type; the same in two lines; or one line, with the rest in the
    /// verdict's reasons and the tool tip.
    enum class Shape { Large, TwoLines, OneLine };
    void setShape(Shape shape);
    [[nodiscard]] int heightOf(Shape shape) const;
    /// Returns the least width at which a line fits title, share, and verdict as shape and word.
    [[nodiscard]] int wordedWidth() const;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    [[nodiscard]] bool oneLine() const;
    void paintLarge(QPainter& painter) const;
    void paintLines(QPainter& painter) const;
    int paintVerdict(QPainter& painter, const QRect& head, int wanted) const;
    void paintBar(QPainter& painter, const QRect& bar) const;
    QString verdict_;
    QString large_;  // "45 %"
    QString beside_;
    QString where_;      // "at 10 V: +0.01 ± 0.08 V"
    QString tolerance_;  // "tolerance ± 200 mV"
    QString whereOf_;    // "at 10 V: +0.01 ± 0.08 V of ± 200 mV"
    double share_ = 0;
    Shape shape_ = Shape::Large;
};

}  // namespace tacto::gui
