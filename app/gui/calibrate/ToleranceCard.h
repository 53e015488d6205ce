// ToleranceCard.h - one calibrated quantity as a card: its verdict, how much of its tolerance is used, and where. A
// click chooses what the plot shows.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QAbstractButton>

#include "app/gui/calibrate/CalibrationReadings.h"

namespace tacto::gui {

class ToleranceCard final : public QAbstractButton {
    Q_OBJECT
public:
    explicit ToleranceCard(const QString& title, QWidget* parent = nullptr);
    void show(const CalibrationReadings& of);
    /// One line and the bar, where there is little room: the reasons of the verdict and the tool tip say the rest.
    void setLow(bool low);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    [[nodiscard]] bool oneLine() const;
    void paintWhole(QPainter& painter) const;
    void paintLow(QPainter& painter) const;
    int paintVerdict(QPainter& painter, const QRect& head, int wanted) const;
    void paintBar(QPainter& painter, const QRect& bar) const;
    QString verdict_;
    QString large_;  // "45 %"
    QString beside_;
    QString where_;      // "at 10 V: +0.01 ± 0.08 V"
    QString tolerance_;  // "tolerance ± 200 mV"
    double share_ = 0;
    bool low_ = false;
};

}  // namespace tacto::gui
