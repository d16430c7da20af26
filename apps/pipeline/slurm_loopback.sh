# Slurm on this machine alone, for a test: slurm_start starts munge, a controller and a node on 127.0.0.1 with folders below
# $scratch, slurm_stop ends these three. Source it after apps/testing.sh.
# shellcheck shell=bash disable=SC2154
slurm_pids=()

# Status 1, with the reason on standard output, where it cannot run.
slurm_start() {
  local program name port
  for program in munged slurmctld slurmd sbatch sinfo; do
    command -v $program >/dev/null || { echo "$program is not installed (Debian: munge slurm-wlm)"; return 1; }
  done
  [ "$(id -u)" -eq 0 ] || { echo "its daemons need root"; return 1; }
  name=$(hostname -s)
  slurm_root=$(mktemp -d)
  mkdir -p "$slurm_root"/{state,spool,log,run,munge}
  chmod 755 "$slurm_root"
  chmod 700 "$slurm_root/munge"
  head -c 1024 /dev/urandom >"$slurm_root/munge/munge.key"
  chmod 400 "$slurm_root/munge/munge.key"
  # Two tests at once take different ports.
  port=$((20000 + $$ % 20000))
  cat >"$slurm_root/slurm.conf" <<CONF
ClusterName=loop
SlurmctldHost=$name(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm_root/munge/munge.socket
CredType=cred/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$slurm_root/state
SlurmdSpoolDir=$slurm_root/spool
SlurmctldPidFile=$slurm_root/run/slurmctld.pid
SlurmdPidFile=$slurm_root/run/slurmd.pid
SlurmctldLogFile=$slurm_root/log/slurmctld.log
SlurmdLogFile=$slurm_root/log/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=bf_interval=1,sched_interval=1,batch_sched_delay=0
ReturnToService=2
MaxArraySize=10001
NodeName=$name NodeAddr=127.0.0.1 CPUs=2 Boards=1 SocketsPerBoard=1 CoresPerSocket=2 ThreadsPerCore=1 RealMemory=1000 State=UNKNOWN
PartitionName=local Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$slurm_root/slurm.conf
  local munge=$slurm_root/munge
  munged --foreground --force --key-file="$munge/munge.key" --socket="$munge/munge.socket" --pid-file="$munge/munged.pid" \
    --log-file="$munge/munged.log" --seed-file="$munge/munged.seed" >/dev/null 2>&1 &
  slurm_pids+=($!)
  sleep 1
  slurmctld -D -c -f "$SLURM_CONF" >/dev/null 2>&1 &
  slurm_pids+=($!)
  sleep 1
  slurmd -D -f "$SLURM_CONF" -N "$name" >/dev/null 2>&1 &
  slurm_pids+=($!)
  local i
  for ((i = 0; i < 40; ++i)); do
    sinfo -h -o %T 2>/dev/null | grep -q idle && return 0
    sleep 0.5
  done
  echo "no node comes up here: $(tail -n 1 "$slurm_root/log/slurmctld.log" 2>/dev/null)"
  slurm_stop
  return 1
}

slurm_stop() {
  local i
  for ((i = ${#slurm_pids[@]} - 1; i >= 0; --i)); do
    kill "${slurm_pids[$i]}" 2>/dev/null
    wait "${slurm_pids[$i]}" 2>/dev/null
  done
  slurm_pids=()
  [ -z "${slurm_root:-}" ] || rm -rf "$slurm_root"
}
