// ElectrodeBox.h - the electrodes that a person has named, each with the area that was typed or confirmed with Enter
// while a new name was shown. Choosing one fills in its area. An area that is typed then and is another clears the
// name: it belongs to no electrode until one is named, and changes none. The user's settings keep them; a session
// records the name in its profile (Profile::electrode).
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QLineEdit>
#include <optional>

namespace tacto::gui {

class ElectrodeBox final : public QComboBox {
    Q_OBJECT
public:
    /// `area` is the line in which the area is typed, in cm².
    ElectrodeBox(QLineEdit& area, QWidget* parent);
    /// The name shown beside an area, which may be empty; nothing without an area.
    [[nodiscard]] std::optional<QString> named() const;
    void showPopup() override;  ///< lists what other forms have added, too

private:
    void list();
    void name();
    void confirm();
    void keep();
    void follow();
    QLineEdit& area_;
};

}  // namespace tacto::gui
