// TrialPlane.h - trials as points in the plane of their two features, while they come: amplitude and interval of
// trains, or the vibration and the taxel feature of a fingertip that slides.
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
    enum class Features { Trains, Slides };

    explicit TrialPlane(QWidget* parent = nullptr);
    void begin(bool simulated, Features features = Features::Trains);
    void setSimulated(bool simulated);
    /// A trial as record.trial() was given it; one without both features is counted and not drawn. A slide of a
    /// fingertip without taxels is drawn over its number.
    void add(const nlohmann::json& trial);
    [[nodiscard]] Features features() const { return features_; }
    [[nodiscard]] int trials() const { return trials_; }
    [[nodiscard]] int drawn() const { return drawn_; }

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void colour();
    void fit();
    void wrapLegend();
    Features features_ = Features::Trains;
    std::vector<std::pair<QString, QCPGraph*>> conditions_;
    QCPItemText* watermark_ = nullptr;
    QCPItemText* empty_ = nullptr;
    int trials_ = 0;
    int drawn_ = 0;
};

}  // namespace tacto::gui
