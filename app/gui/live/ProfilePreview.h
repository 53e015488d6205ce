// ProfilePreview.h - an encoding profile as plots: roughness to amplitude and pressure to interval, each with the
// present touch, and one pulse.
#pragma once

#include <optional>
#include <qcustomplot.h>

#include "core/encoding/EncodingProfile.h"

namespace tacto::gui {

class ProfilePreview final : public QCustomPlot {
    Q_OBJECT
public:
    explicit ProfilePreview(QWidget* parent = nullptr);
    /// `profile` must have passed validate(); charge is shown for `smallestLoad` until an impedance is measured.
    void show(const EncodingProfile& profile, Ohms smallestLoad);
    /// Sets the point of the present touch; NaN if nothing is touched.
    void setPoint(double roughness, double pressure);
    /// Sets the measured impedance; NaN: not measured.
    void setImpedance(double ohm);
    /// Returns the numbers of a pulse at the largest amplitude: charge per phase, imbalance, duration.
    [[nodiscard]] QString facts() const;
    /// Returns the command marked on the curves.
    [[nodiscard]] std::optional<QPointF> marked() const;

private:
    void colour();
    void showCurves();
    void showPulse();
    void showPoint();

    std::optional<EncodingProfile> profile_;
    double smallestLoad_ohm_ = 0;
    double impedance_ohm_;
    double roughness_, pressure_;
    double fluxFirst_Vs_ = 0, fluxSecond_Vs_ = 0;  // signed fluxes of the phases; over a resistance they are charges
    QCPAxisRect* amplitude_;
    QCPAxisRect* interval_;
    QCPAxisRect* pulse_;
    QCPGraph* amplitudeCurve_ = nullptr;
    QCPGraph* intervalCurve_ = nullptr;
    QCPGraph* amplitudePoint_ = nullptr;
    QCPGraph* intervalPoint_ = nullptr;
    QCPGraph* wave_ = nullptr;
};

}  // namespace tacto::gui
