#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace bulbus::inline io {

struct LocalMesh;

/// Keeps what is given to it under a name, or gives back what was kept: whatever has a memory says in one
/// function `serialize(Archive&)` what that is, for writing and for reading alike. All members are
/// collective, with the same names on every rank.
class Archive {
 public:
  /// What the rows of a table belong to, the same however many ranks there are. A row that several ranks hold
  /// is `mine` on one.
  struct Keys {
    std::vector<long long> keys;
    std::vector<char> mine;
    void add(long long key, bool is_mine) { keys.push_back(key), mine.push_back(is_mine); }
  };
  /// A part of the names while it lives.
  class Group {
   public:
    Group(Archive& archive, const std::string& name) : archive_(archive), before_(archive.prefix_) {
      archive.prefix_ = archive.path_of(name) + "/";
    }
    ~Group() { archive_.prefix_ = before_; }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

   private:
    Archive& archive_;
    std::string before_;
  };

  explicit Archive(const LocalMesh& mesh);
  virtual ~Archive() = default;

  /// Are values given back, in place of being kept?
  virtual bool reading() const = 0;
  /// Is there anything to give back under this name, or group?
  virtual bool knows(const std::string& name) const = 0;
  /// The same numbers on every rank, as many as there are.
  virtual void numbers(const std::string& name, std::vector<double>& values) = 0;
  virtual void text(const std::string& name, std::string& value) = 0;
  /// `width` numbers per key. Rows that were not kept stay as they are.
  virtual void rows(const std::string& name, const Keys& keys, int width, std::vector<double>& values) = 0;
  /// 3 numbers per local node of the finest mesh, ghosts included.
  void nodes(const std::string& name, std::vector<double>& values) {
    mesh_table(name, "node", nodes_, 3, values);
  }
  /// One number per local hexahedron of the finest mesh.
  void hexes(const std::string& name, std::vector<double>& values) {
    mesh_table(name, "hexahedron", hexes_, 1, values);
  }

  /// Plain numbers one by one, the same on every rank.
  template <class... Number>
  void scalars(const std::string& name, Number&... value) {
    std::vector<double> all{static_cast<double>(value)...};
    numbers(name, all);
    std::size_t i = 0;
    ((value = static_cast<Number>(all.at(i++))), ...);
  }

 protected:
  /// Slashes part groups; those of names that people gave do not.
  std::string path_of(std::string name) const {
    std::ranges::replace(name, '/', '|');
    return prefix_ + name;
  }
  /// Rows for every key; the keys are kept once for all tables that name them alike.
  virtual void mesh_table(const std::string& name, const std::string& of, const Keys& keys, int width,
                          std::vector<double>& values) = 0;

 private:
  Keys nodes_, hexes_;
  std::string prefix_;
};

}  // namespace bulbus::inline io
