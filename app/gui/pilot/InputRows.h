// InputRows.h - rows of a form: the game pads and foot switches that are plugged in, whom each is assigned to, and what
// each of its buttons does. A button that is pressed lights up, so the operator sees that it works and which it is.
//
// A device keeps the use that it had in the last session of the same study, if its serial number tells it from others;
// without a serial number the use is only offered, since it may be another of its model.
//
// While the rows are shown, devices are looked for and opened, but never those of a running session.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QString>
#include <QTimer>
#include <QVBoxLayout>
#include <QWidget>
#include <map>
#include <optional>
#include <vector>

#include "app/gui/controller/SideWork.h"
#include "app/gui/pilot/ButtonUse.h"
#include "app/gui/pilot/SessionInputs.h"

namespace tacto::gui {

class InputRows final : public QWidget {
    Q_OBJECT
public:
    explicit InputRows(QWidget* parent = nullptr);
    /// Null: there are none.
    void setDevices(std::shared_ptr<const ButtonDevices> devices);
    [[nodiscard]] const std::shared_ptr<const ButtonDevices>& devices() const { return open_.devices(); }
    /// The study's id, or kRehearsals. What was chosen before is forgotten.
    void setPlace(const QString& place);
    /// The devices that are assigned to a person and do something.
    [[nodiscard]] std::vector<SeatedDevice> seats() const;
    /// Why a session cannot begin with these, a sentence; empty where it can.
    [[nodiscard]] QString missing() const;

signals:
    void changed();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    struct Row {
        SeatedDevice seat;
        bool assigned = false;
        bool there = true;
        std::optional<SeatedDevice> before{};  ///< how this device, or one of its model, was seated in the last session
        QString trouble;                       ///< why it cannot be opened
        QWidget* widget = nullptr;
        std::vector<QLabel*> lamps{};
    };
    void look();
    void list(const std::vector<ButtonDeviceInfo>& found);
    void tryOpen(Row& row);
    void build();
    [[nodiscard]] QWidget* build(Row& row);
    void buildBefore(Row& row, QVBoxLayout& column);
    void seatAsBefore(Row& row);
    void buildButtons(Row& row, QVBoxLayout& column);
    void light(const std::string& identity, std::size_t button, bool down);
    [[nodiscard]] Row* find(const std::string& identity);

    OpenButtons open_;
    SideWork looker_;
    QTimer looking_;
    bool looks_ = false;  ///< looker_ is at it
    QString place_;
    std::vector<Row> rows_;
    QLabel* none_;
    QVBoxLayout* column_;
};

/// Remembers whose the game pads and foot switches were in the last session of a study, and what their buttons did. It
/// stands in the user's settings, by the devices' identities; nothing of a person is kept. `place`: the study's id, or
/// kRehearsals. What was remembered of it before is forgotten.
void rememberInputs(const QString& place, const std::vector<SeatedDevice>& seats);
/// How this device was seated; nothing where it was not used there, or has other buttons by now. A device without a
/// serial number (ButtonDeviceInfo::hasSerial) is taken for any other of its model.
[[nodiscard]] std::optional<SeatedDevice> rememberedInput(const QString& place, const ButtonDeviceInfo& device);

inline constexpr const char* kRehearsals = "rehearsals";

}  // namespace tacto::gui
