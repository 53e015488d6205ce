// FieldForm.h - the program's form: for each described field a label, an editor, a range and, if refused, the reason.
//
// A field is described like a parameter in a protocol: name, label, unit, range, choices. Days are chosen in a
// calendar, files in a dialog. Fields that decide a verdict come first. The parameters of the known reference form a
// separate part.
//
// Every field is text and is checked by the same rules as on the command line; the reason for a refusal stands below
// the field. If 0 has a meaning, an empty field shows the words for this meaning and reads as 0.
#pragma once

#include <QFormLayout>
#include <QLabel>
#include <QPointer>
#include <QWidget>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "app/gui/theme/Labels.h"
#include "app/scripting/engine/ProtocolDeclaration.h"

namespace tacto::gui {

class ElectrodeBox;

struct FormField {
    ProtocolParameter parameter;
    QString tip{};
    QString hint{};          ///< shown in an empty line
    QString range{};         ///< shown instead of the parameter's own range if the owner checks the value
    QWidget* own = nullptr;  ///< a widget shown instead of an editor; the form owns it and does not read it
};
/// `choices`: keys and words; the first one is selected.
[[nodiscard]] FormField choiceField(const char* name, const QString& label,
                                    const std::vector<std::pair<QString, QString>>& choices, const QString& tip);
[[nodiscard]] FormField textField(const char* name, const QString& label, const QString& value, const QString& tip,
                                  const QString& hint = {});
[[nodiscard]] FormField dayField(const char* name, const QString& label, const QString& tip, const QString& hint);
[[nodiscard]] FormField numberField(const char* name, const QString& label, const char* unit, double least, double most,
                                    double value, const QString& tip);
[[nodiscard]] FormField wholeField(const char* name, const QString& label, int least, int most, int value,
                                   const QString& tip);
[[nodiscard]] FormField tickField(const char* name, const QString& label, bool value, const QString& tip = {});
/// A field without a label takes the whole width.
[[nodiscard]] FormField ownField(const QString& label, QWidget* own);

class FieldForm final : public QWidget {
    Q_OBJECT
public:
    /// Above: labels above their fields, for narrow columns. Beside: labels next to their fields if there is room.
    enum class Labels { Above, Beside };
    explicit FieldForm(QWidget* parent = nullptr, Labels labels = Labels::Above);
    void show(const ProtocolDeclaration& declaration);
    void show(const std::vector<FormField>& fields);
    /// The fields of the known reference, which the owner places and shows. Empty if the protocol has none.
    [[nodiscard]] QWidget& referencePart() { return *reference_; }
    [[nodiscard]] bool hasReference() const;
    /// Errors: the error of the first refused field; the form shows all refusals.
    [[nodiscard]] Result<ProtocolSettings> read();
    /// The present text of a parameter; empty if there is no such parameter.
    [[nodiscard]] QString text(const std::string& name) const;
    /// Writes into a field as if the text were typed. Does nothing for an unknown name or choice.
    void set(const std::string& name, const QString& text);
    /// As set(), for a value that the page proposes: summary() does not count it as changed.
    void propose(const std::string& name, const QString& text);
    /// Replaces the choices of a field. Keeps the selected one if it still exists, else selects the first one.
    void setChoices(const std::string& name, const std::vector<std::pair<QString, QString>>& choices);
    /// Shows below a field why its owner refuses the value, until it is edited; an empty text: the value is valid.
    void refuse(const std::string& name, const QString& why);
    /// Focuses the field and selects all its text.
    void goTo(const std::string& name);
    void setRowVisible(const std::string& name, bool visible);
    void setRowVisible(QWidget& own, bool visible);
    [[nodiscard]] bool isRowVisible(QWidget& own) const;
    void setFieldEnabled(const std::string& name, bool enabled);
    /// The name beside the area of an electrode, which may be empty; nothing if there is no such field or no area in
    /// it.
    [[nodiscard]] std::optional<QString> electrode() const;
    void nameElectrode(const QString& name);
    /// Parameters with an answer from elsewhere, such as the electrode's area from the profile: 0 is then accepted.
    void setKnown(std::set<std::string> names);
    /// Reports a missing entry only after the operator has left the field, or after read() or goToRefused().
    void setMissingSaidOnceLeft() { missingSaidOnceLeft_ = true; }
    /// A sentence about the first missing parameter that decides the verdict; empty if none is missing.
    [[nodiscard]] QString unanswered() const;
    /// A sentence about the first field whose value cannot be read, with its label; empty if there is none. Leaves out
    /// fields that are hidden or cannot be edited now.
    [[nodiscard]] QString refusal() const;
    /// refusal(), or else unanswered().
    [[nodiscard]] QString wrong() const;
    /// The parameters that decide the verdict, and how many differ from what the form proposed: "4 cm² · 2 changed".
    [[nodiscard]] QString summary() const;
    /// Number of fields in this part that are refused, or that have no answer although the verdict needs one.
    [[nodiscard]] int refused(bool reference) const;
    /// Focuses the first such field. Returns true if it belongs to the reference; nothing if there is no such field.
    std::optional<bool> goToRefused();

signals:
    void edited();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Field {
        ProtocolParameter parameter;
        QString tip{}, hint{}, takes{};
        std::function<QString()> text;
        std::function<void(const QString&)> write;
        QWidget* editor = nullptr;  // has the parameter's name as object name
        QWidget* whole = nullptr;   // the editor with its buttons
        QWidget* row = nullptr;
        TroubleLine* trouble = nullptr;
        QLabel* label = nullptr;
        QLabel* range = nullptr;  // empty if the field has no range
        QString atFirst{};        // the text for the script's default
        QString proposed{};       // that text, or what propose() wrote last
        QString why{};            // why the present text is refused
        bool left = false;        // the user has left the field, or was asked for its missing entry
    };
    [[nodiscard]] Field makeField(const FormField& described);
    void showFields(const std::vector<FormField>& fields);
    void addOwn(const FormField& described);
    [[nodiscard]] const Field* find(const std::string& name) const;
    [[nodiscard]] Field* find(const std::string& name);
    void addLine(Field& field);
    void addFileChooser(Field& field);
    void addRow(Field& field);
    [[nodiscard]] bool lacks(const Field& field) const;
    void fitLabels();
    void judge();
    void say(const Field& field, bool lacking) const;
    void askForAll();
    const Labels labels_;
    ProtocolDeclaration declaration_;
    QFormLayout* settingsRows_;
    QWidget* reference_;
    QFormLayout* referenceRows_;
    std::vector<Field> fields_;
    QPointer<ElectrodeBox> electrode_;
    std::set<std::string> known_;
    bool missingSaidOnceLeft_ = false;
};

}  // namespace tacto::gui
