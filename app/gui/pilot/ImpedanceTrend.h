// ImpedanceTrend.h - plot of the impedance over a session: one point per trial, the blocks, and the allowed band.
//
// Each trial has exactly one point, so that the plot does not reveal the number of trains.
#pragma once

#include <QLabel>
#include <QWidget>
#include <map>
#include <qcustomplot.h>

namespace tacto::gui {

class ImpedanceTrend final : public QWidget {
    Q_OBJECT
public:
    explicit ImpedanceTrend(QWidget* parent = nullptr);
    void clear();
    /// Scales the axes for a test with this number of trials and blocks.
    void setPlan(int trials, int blocks);
    void setSimulated(bool simulated);
    /// Stores the last reading of a trial, counted from 1; the first reading sets the band. Ignores NaN.
    void note(int trial, double ohm);

private:
    void draw();
    QLabel* title_;
    QLabel* now_;
    QCustomPlot* plot_;
    QCPGraph* points_;
    QCPItemRect* band_;
    std::vector<QCPItemLine*> edges_;
    QCPItemText* empty_ = nullptr;
    QCPItemText* bandWord_;
    QCPItemText* watermark_;
    std::vector<QCPItemLine*> blockLines_;
    std::vector<QCPItemText*> blockWords_;
    std::map<int, double> ohms_;
    double start_ohm_ = 0;
    int trials_ = 0, blocks_ = 0;
};

}  // namespace tacto::gui
