// MPI_Init_thread and MPI_Finalize as one object in main(). Only the thread that made it may use MPI.
#pragma once

namespace footwall::comm {

class Environment {
 public:
  // Throws Error kEngine where the library offers less than MPI_THREAD_FUNNELED.
  Environment(int& argc, char**& argv);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
};

}  // namespace footwall::comm
