// FieldForm.h - the one form of the program: a label, an editor, a range and a refusal for each field of a description.
//
// A field is what a protocol declares of a parameter: name, label, unit, range, choices. Days are chosen in a calendar,
// files by a dialog. What decides a verdict stands first. The parameters of the known reference are a part of their
// own.
//
// Every field is text checked by the same rules as the command line; a refusal stands below its field. Where the
// description says what 0 stands for, those words stand in an empty field, which reads as 0.
#pragma once

#include <QFormLayout>
#include <QLabel>
#include <QWidget>
#include <functional>
#include <set>
#include <vector>

#include "app/gui/theme/Labels.h"
#include "app/scripting/engine/ProtocolDeclaration.h"

namespace tacto::gui {

struct FormField {
    ProtocolParameter parameter;
    QString tip{};
    QString hint{};          ///< stands in a line that is empty
    QString range{};         ///< in place of what the parameter takes, where its owner judges it
    QWidget* own = nullptr;  ///< in place of an editor: it is shown and placed, and not read; the form takes it
};
/// `choices`: key and words; the first is chosen.
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
/// A field without a label has the whole width.
[[nodiscard]] FormField ownField(const QString& label, QWidget* own);

class FieldForm final : public QWidget {
    Q_OBJECT
public:
    /// Labels above their fields, in a narrow column; or beside them where there is room.
    enum class Labels { Above, Beside };
    explicit FieldForm(QWidget* parent = nullptr, Labels labels = Labels::Above);
    void show(const ProtocolDeclaration& declaration);
    void show(const std::vector<FormField>& fields);
    /// The fields of the known reference, to be placed and shown by the owner. Empty where the protocol has none.
    [[nodiscard]] QWidget& referencePart() { return *reference_; }
    [[nodiscard]] bool hasReference() const;
    /// Errors: of the first field that is refused; all refusals are shown.
    [[nodiscard]] Result<ProtocolSettings> read();
    /// The text of a parameter as it stands; empty for none of that name.
    [[nodiscard]] QString text(const std::string& name) const;
    /// Writes into a field, as if it were typed; a name or a choice that is not there is left alone.
    void set(const std::string& name, const QString& text);
    /// What a choice offers from now on: what was chosen stays where it is still there, else the first one is.
    void setChoices(const std::string& name, const std::vector<std::pair<QString, QString>>& choices);
    /// Says below a field why its owner refuses what stands there, until it is edited; an empty text: it is sound.
    void refuse(const std::string& name, const QString& why);
    /// The field gets the focus, and all of its text is marked.
    void goTo(const std::string& name);
    void setRowVisible(const std::string& name, bool visible);
    void setRowVisible(QWidget& own, bool visible);
    [[nodiscard]] bool isRowVisible(QWidget& own) const;
    void setFieldEnabled(const std::string& name, bool enabled);
    /// Parameters whose answer is known from elsewhere, as the electrode's area from the profile: for these 0 will do.
    void setKnown(std::set<std::string> names);
    /// A missing entry is pointed out only once the operator has left the field, or read() or goToRefused() was called.
    void setMissingSaidOnceLeft() { missingSaidOnceLeft_ = true; }
    /// The sentence about the first parameter that decides the verdict and has no answer; empty for none.
    [[nodiscard]] QString unanswered() const;
    /// The parameters that decide the verdict, and how many differ from the script's own: "4 cm² · 2 changed".
    [[nodiscard]] QString summary() const;
    /// How many fields of the part are refused as they stand, or have no answer though the verdict needs it.
    [[nodiscard]] int refused(bool reference) const;
    /// Gives the focus to the first such field. Returns whether it belongs to the reference; nothing without one.
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
        QWidget* editor = nullptr;  // has the parameter's name
        QWidget* whole = nullptr;   // the editor with its buttons
        QWidget* row = nullptr;
        TroubleLine* trouble = nullptr;
        QLabel* label = nullptr;
        QLabel* range = nullptr;  // empty where it has none
        QString atFirst{};        // the text as the script's default shows it
        QString why{};            // why it is refused as it stands
        bool left = false;        // the user has left it, or was asked for what it lacks
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
    std::set<std::string> known_;
    bool missingSaidOnceLeft_ = false;
};

}  // namespace tacto::gui
