// StopKeys.h - Esc, Pause and Space stop the output wherever the focus is, also in dialogs. In a text field Space types
// a space. Return presses the focused button, because Space cannot (hazard H6).
//
// Installed on the application, so that it sees each key before any widget. Qt would hide keys and clicks in a window
// behind a modal dialog even from the application, so StopKeys makes every window non-modal before it is shown, also
// those that Qt opens by itself. During a drag Qt puts its own filter before all others and takes every key, so
// StopKeys puts itself first again 20 times a second, as long as there is an output to stop.
#pragma once

#include <QObject>
#include <QTimer>
#include <functional>

class QKeyEvent;

namespace tacto::gui {

/// A held key repeats presses and releases, and X does not always mark them as repeats. So Return counts as one press
/// until no further press has come for kReleased_ms and it is not down. Its release is lost if the press closed the
/// window that had the keys: where the display cannot tell, Return counts as released once it was silent for
/// kSilent_ms.
class StopKeys final : public QObject {
    Q_OBJECT
public:
    /// `stop` is called before anything else, with a text such as "operator (Esc)", or "operator (Esc, held)" while the
    /// key repeats; with "participant (Esc)" if the key went to a window whose property "stopsAs" is "participant".
    StopKeys(std::function<void(const char*)> stop, QObject* parent);
    ~StopKeys() override;
    /// Whether to come first also in a drag, which takes every key; true at first.
    void stayFirst(bool stays);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    [[nodiscard]] static bool isParticipants(const QObject* watched);
    [[nodiscard]] bool pressed(QObject* watched, const QKeyEvent& key);
    [[nodiscard]] bool returnPressed(QObject* watched, const QKeyEvent& key);
    static constexpr int kReleased_ms = 150, kSilent_ms = 1000;
    const std::function<void(const char*)> stop_;
    bool returnHeld_ = false;
    quint32 returnCode_ = 0;
    QTimer returnReleased_, first_;
};

}  // namespace tacto::gui
