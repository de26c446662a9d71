"""Only calls of MPI 3.1: the libraries of clusters are old."""
import pathlib
import re
import unittest

from support import SOURCE

# What MPI 4.0 and later brought, by name or by its pattern.
NEWER = re.compile(r"""MPI_(Session_\w+|\w+_c|Isendrecv(_replace)?|P(send|recv)_init|Pready(_range|_list)?|Parrived
    |(Barrier|Bcast|Gatherv?|Scatterv?|Allgatherv?|Alltoall[vw]?|Reduce|Allreduce|Reduce_scatter(_block)?|Scan|Exscan
       |Neighbor_\w+)_init
    |Comm_idup_with_info|Comm_create_from_group|Intercomm_create_from_groups|Group_from_session_pset|Info_get_string
    |Info_create_env|COMM_TYPE_(HW_\w+|RESOURCE_GUIDED)|ERRORS_ABORT|F_STATUS_SIZE|Abi_\w+|Status_(get|set)_\w+
    |Request_get_status_(all|any|some)|Buffer_\w+|Comm_(attach|detach|flush)_buffer|Remove_error_\w+)$""", re.VERBOSE)
ALLOWED = {"MPI_Status_set_cancelled", "MPI_Status_set_elements", "MPI_Status_set_elements_x"}


class MpiCalls(unittest.TestCase):
    def test_none_is_newer_than_3_1(self):
        calls = {}
        for folder in ("storage", "engine", "app"):
            for path in (SOURCE / folder).rglob("*"):
                if path.suffix in (".cpp", ".h"):
                    for word in re.findall(r"\bMPI_\w+", path.read_text()):
                        calls.setdefault(word, pathlib.Path(path).relative_to(SOURCE))
        self.assertGreater(len(calls), 20, "the search finds nothing any more")
        self.assertIn("MPI_Init_thread", calls)
        newer = {word: str(path) for word, path in calls.items() if NEWER.match(word) and word not in ALLOWED}
        self.assertEqual(newer, {})

    def test_the_list_knows_newer_calls(self):
        for word in ("MPI_Session_init", "MPI_Send_c", "MPI_Allreduce_init", "MPI_Psend_init", "MPI_Info_get_string"):
            self.assertTrue(NEWER.match(word), word)
        for word in ("MPI_Send", "MPI_Send_init", "MPI_Allreduce", "MPI_Init_thread", "MPI_Comm_split_type"):
            self.assertFalse(NEWER.match(word), word)


if __name__ == "__main__":
    unittest.main()
