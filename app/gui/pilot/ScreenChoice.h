// ScreenChoice.h - which screen is the participant's: by its name, remembered, and watched.
//
// Where there is one screen the participant's window covers it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>

class QScreen;

namespace tacto::gui {

class ScreenChoice final : public QComboBox {
    Q_OBJECT
public:
    explicit ScreenChoice(QWidget* parent = nullptr);
    /// The chosen one; null when it is gone.
    [[nodiscard]] QScreen* chosen() const;
    /// The chosen one; where it is gone another is chosen, as at first. Null without any screen.
    [[nodiscard]] QScreen* seat();
    [[nodiscard]] QString chosenName() const { return currentData().toString(); }
    /// Whether the operator's window has one of its own beside it.
    [[nodiscard]] static bool isOnly();

signals:
    void lost(const QString& name);  ///< the chosen one
    void back(const QString& name);

private:
    void fill();
};

}  // namespace tacto::gui
