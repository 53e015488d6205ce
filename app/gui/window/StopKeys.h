// StopKeys.h - Esc, Pause and Space stop the output from wherever the focus is, dialogs included; Space types where
// text is typed, and Return presses the focused button instead (hazard H6).
//
// Installed on the application: it sees each key before any widget does. Qt would keep the keys and clicks of a window
// behind a modal dialog from the application as well, so StopKeys takes the modality from every window before it is
// shown, also from those that Qt opens by itself. While something is dragged Qt puts a filter of its own before all
// others and takes every key; StopKeys puts itself first again twenty times a second.
#pragma once

#include <QObject>
#include <QTimer>
#include <functional>

class QKeyEvent;

namespace tacto::gui {

/// A held key repeats as presses and releases that X does not always mark as repeated: Return counts as released when
/// no press has followed for kReleased_ms, and is one press until then.
class StopKeys final : public QObject {
    Q_OBJECT
public:
    /// `stop` is called first thing, with "operator (Esc)" and the like, "operator (Esc, held)" while it repeats; with
    /// "participant (Esc)" where the key went to a window whose property "stopsAs" is "participant".
    StopKeys(std::function<void(const char*)> stop, QObject* parent);
    ~StopKeys() override;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void timerEvent(QTimerEvent* event) override;

private:
    [[nodiscard]] static bool isParticipants(const QObject* watched);
    [[nodiscard]] bool pressed(QObject* watched, const QKeyEvent& key);
    [[nodiscard]] bool returnPressed(QObject* watched, const QKeyEvent& key);
    static constexpr int kReleased_ms = 150;
    const std::function<void(const char*)> stop_;
    bool returnHeld_ = false;
    QTimer returnReleased_;
};

}  // namespace tacto::gui
