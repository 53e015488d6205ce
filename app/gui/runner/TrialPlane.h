// TrialPlane.h - trials as points in the amplitude-interval plane, while they come.
//
// Thread-safety: the GUI thread.
#pragma once

#include <nlohmann/json.hpp>
#include <qcustomplot.h>
#include <vector>

namespace tacto::gui {

class TrialPlane final : public QCustomPlot {
    Q_OBJECT
public:
    explicit TrialPlane(QWidget* parent = nullptr);
    void begin(bool simulated);
    void setSimulated(bool simulated);
    /// A trial as record.trial() was given it; one without both features is counted and not drawn.
    void add(const nlohmann::json& trial);
    [[nodiscard]] int trials() const { return trials_; }
    [[nodiscard]] int drawn() const { return drawn_; }

protected:
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void colour();
    void fit();
    std::vector<std::pair<QString, QCPGraph*>> conditions_;
    QCPItemText* watermark_ = nullptr;
    QCPItemText* empty_ = nullptr;
    int trials_ = 0;
    int drawn_ = 0;
};

}  // namespace tacto::gui
