// ElectrodeBox.h - the electrodes that a person has named, each with the area that was typed for it last. Choosing one
// fills in its area; another area that is typed while it is named is kept with it. The user's settings keep them.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QLineEdit>

namespace tacto::gui {

class ElectrodeBox final : public QComboBox {
    Q_OBJECT
public:
    /// `area` is the line in which the area is typed, in cm².
    ElectrodeBox(QLineEdit& area, QWidget* parent);
    void showPopup() override;  ///< lists what other forms have added, too

private:
    void list();
    void name();
    void keep();
    void follow();
    QLineEdit& area_;
};

}  // namespace tacto::gui
