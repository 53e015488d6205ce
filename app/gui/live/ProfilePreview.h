// ProfilePreview.h - an encoding profile as pictures: roughness to amplitude, pressure to interval, and one pulse.
//
// Thread-safety: the GUI thread.
#pragma once

#include <qcustomplot.h>

#include "core/encoding/EncodingProfile.h"

namespace tacto::gui {

class ProfilePreview final : public QCustomPlot {
    Q_OBJECT
public:
    explicit ProfilePreview(QWidget* parent = nullptr);
    /// A profile that passed validate().
    void show(const EncodingProfile& profile);
    /// What the pulse says in numbers: charge per phase into 1 kΩ at the largest amplitude, imbalance, duration.
    [[nodiscard]] const QString& facts() const { return facts_; }

protected:
    void changeEvent(QEvent* event) override;

private:
    void colour();
    QCPAxisRect* amplitude_;
    QCPAxisRect* interval_;
    QCPAxisRect* pulse_;
    QCPGraph* amplitudeCurve_ = nullptr;
    QCPGraph* intervalCurve_ = nullptr;
    QCPGraph* wave_ = nullptr;
    QString facts_;
};

}  // namespace tacto::gui
