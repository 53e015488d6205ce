// CommandPanel.h - shows in words what the fingertip feels now, and what became of its trains.
#pragma once

#include <QLabel>
#include <QWidget>

#include "core/bench/Telemetry.h"
#include "core/encoding/EncodingProfile.h"

namespace tacto::gui {

class CommandPanel final : public QWidget {
    Q_OBJECT
public:
    explicit CommandPanel(QWidget* parent = nullptr);
    /// `stale`: the fingertip's samples are old, so what it felt last may no longer hold. Names one of `conditions` if
    /// the point is near it.
    void show(const Telemetry& telemetry, bool stale, const std::vector<Condition>& conditions);

private:
    QLabel* words_;
    QLabel* near_;
    QLabel* trains_;
    QLabel* refusal_;
};

/// The fingertip's state in words: how fresh the samples are, how many were lost, and the flags of R (roughness).
/// `stale` marks values that must not be trusted.
struct HealthWords {
    QString text;
    bool stale = false;
};
[[nodiscard]] HealthWords healthWords(const Telemetry& telemetry, bool hasSensor, std::uint64_t missedByPicture);

}  // namespace tacto::gui
