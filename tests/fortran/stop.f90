! Ends by a failure without stat; the argument says which.
program stop_program
  use lanescape
  implicit none
  type(lanescape_model) :: model, other
  character(20) :: argument
  call get_command_argument(1, argument)
  if (argument == "refused") call model%named("no-such-model")
  call model%named("kob-andersen")
  if (argument == "assigned") other = model
end program stop_program
