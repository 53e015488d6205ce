// ImpedanceTrend.h - impedance over a session: a point a trial, with the band that it may move in and the blocks.
//
// Each trial is one point and no more, so that the number of trains cannot be read from it.
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
    /// Axes for a test of so many trials and blocks.
    void setPlan(int trials, int blocks);
    void setSimulated(bool simulated);
    /// Notes the last reading in that trial, from 1; the first one sets the band. NaN is left out.
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
