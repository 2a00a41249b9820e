#include "io/model_file.hpp"

#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "io/model_file_kinds.hpp"

namespace lanescape {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;  // [bytes]

AnyModel read_model(const TomlReader& toml, const std::string& default_name) {
  const toml::node& kind = toml.need(toml.root(), "kind");
  const std::string word = toml.text(kind, "kind");
  const toml::node* name = toml.root().get("name");
  const std::string model_name = name ? toml.text(*name, "name") : default_name;
  for (const PairForm& form : pair_forms())
    if (word == form.word) return read_pair_model(toml, form, model_name);
  if (word == "hard-sphere") return read_hard_sphere_model(toml, model_name);
  if (word == "ucg") return read_state_mixture_model(toml, model_name);
  toml.refuse(kind, fmt::format("unknown kind '{}': allowed are {}, hard-sphere, ucg", word, pair_form_words()));
}

std::string read_text(const std::filesystem::path& path) {
  const auto refuse = [&](std::string_view what) {
    throw_bad_input(fmt::format("{}: {}: a readable TOML file of at most {} bytes is needed", path.string(), what, largest_file));
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) refuse("it is a folder");
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse("it cannot be opened");
  std::string content(largest_file + 1, '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (in.bad()) refuse("reading failed");
  content.resize(static_cast<std::size_t>(in.gcount()));
  if (content.size() > largest_file) refuse("it is too large");
  return content;
}

AnyModel parse_model(const std::string& content, const std::string& file, const std::string& default_name) {
  try {
    const toml::table root = toml::parse(content);
    return read_model(TomlReader(file, root), default_name);
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    std::replace_if(what.begin(), what.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    throw_bad_input(fmt::format("{}:{}: {}: valid TOML is needed", file, error.source().begin.line, what));
  }
}

}  // namespace

AnyModel read_model_file(const std::filesystem::path& path) {
  return parse_model(read_text(path), path.string(), path.stem().string());
}

AnyModel read_model_text(const std::string& text, const std::string& source) { return parse_model(text, source, "mixture"); }

void write_model_file(std::ostream& out, const AnyModel& model) {
  const std::string text = std::visit(
      [](const auto& m) {
        m.check();
        return to_toml(m);
      },
      model);
  // The reader is stricter than check() on names and fractions; what it would refuse is not written.
  const std::string& name = mixture_of(model).name;
  parse_model(text, "model " + name, name);
  out << text;
}

}  // namespace lanescape
